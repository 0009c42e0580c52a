#include "window/launch.hpp"

#include "window/crash_dialog.hpp"
#include "window/guarded_application.hpp"
#include "window/main_window.hpp"
#include "window/scene_clipboard.hpp"
#include "window/theme.hpp"

#include <QApplication>
#include <QEvent>
#include <QTimer>

#include <clocale>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <unistd.h>

namespace {

/// For the start-up benchmark (JET_TRACE_FIRST_FRAME=1): tells how long after the start of the process the window's
/// first frame was painted.
class FirstFrame final : public QObject {
public:
    using QObject::QObject;
    bool eventFilter(QObject* target, QEvent* event) override
    {
        if (told_ || event->type() != QEvent::UpdateRequest || !target->isWidgetType()) return false;
        told_ = true;
        QTimer::singleShot(0, this, [] {  // after the paint that this event asks for
            std::printf("first frame after %.0f ms\n", sinceStartMs());
            std::fflush(stdout);
        });
        return false;
    }

private:
    static double sinceStartMs()
    {
        std::ifstream stat("/proc/self/stat");
        const std::string text{std::istreambuf_iterator<char>(stat), {}};
        std::istringstream fields(text.substr(text.rfind(')') + 2));  // from field 3, the state, on
        std::string skipped;
        for (int field = 3; field < 22; ++field) fields >> skipped;
        double startTicks = 0;
        fields >> startTicks;
        timespec now{};
        clock_gettime(CLOCK_BOOTTIME, &now);
        return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) / 1e6 -
               startTicks * 1e3 / static_cast<double>(sysconf(_SC_CLK_TCK));
    }
    bool told_ = false;
};

}  // namespace

namespace {

using namespace jet::host;

/// What the user answered to the crash dialog about work that was not saved.
struct CrashAnswer {
    bool asked = false;  // so that nothing asks again
    std::filesystem::path recover;
};

/// Asks what shall become of plugins and work after a crash. None: the user wants to quit.
std::optional<CrashAnswer> askAfterCrash(WindowLaunch& launch)
{
    if (launch.crashes.empty()) return CrashAnswer{};
    const auto file = launch.project.empty() ? jet::Result<std::filesystem::path>(launch.project)
                                             : jet::findProjectFile(launch.project);
    const auto work = file ? ProjectController::unsavedWork(*file) : std::vector<jet::JournalInfo>();
    CrashDialog dialog(launch.crashes, work);
    if (dialog.exec() == QDialog::Rejected) return std::nullopt;
    launch.safeMode = launch.safeMode || dialog.safeMode();
    if (launch.goOn) launch.goOn(dialog.leftOut(), dialog.safeMode());
    CrashAnswer answer{!work.empty(), {}};
    const RecoveryChoice choice = dialog.recovery();
    if (choice.kind == RecoveryChoice::Kind::Recover) answer.recover = work.at(choice.index).file;
    // What cannot be removed is offered again at the next start.
    if (choice.kind == RecoveryChoice::Kind::Discard) (void)jet::Journal::remove(work.at(choice.index).file);
    return answer;
}

/// The project of the start: recovered, opened, or a new one.
void openFirst(MainWindow& window, const WindowLaunch& launch, const CrashAnswer& answer)
{
    ProjectController& projects = window.projects();
    if (!answer.recover.empty() && projects.recover(answer.recover)) return;
    const auto& project = launch.project;
    if (!project.empty() && (answer.asked ? projects.openAsSaved(project) : projects.open(project))) return;
    projects.create();
}

}  // namespace

int jet_run_window(int argc, char** argv, const jet::host::WindowLaunch& given)
{
    WindowLaunch launch = given;
    jet::host::GuardedApplication application(argc, argv, launch.runtime);
    std::setlocale(LC_NUMERIC, "C");  // QApplication sets the user's: numbers in files and scripts have a point
    QApplication::setApplicationName("JET");
    QApplication::setDesktopFileName("jet");
    jet::host::applyTheme(application);
    const auto answer = askAfterCrash(launch);
    if (!answer) return 0;
    jet::host::MainWindow window(launch);
    application.setMessageHandler([&window](const std::string& message) { window.showMessage(message); });
    window.restoreSettings();
    openFirst(window, launch, *answer);
    FirstFrame firstFrame;
    if (qEnvironmentVariableIsSet("JET_TRACE_FIRST_FRAME")) application.installEventFilter(&firstFrame);
    window.show();
    // What a crash left of other projects is offered once the window is there; opening one offers its own.
    if (launch.project.empty() && !answer->asked)
        QTimer::singleShot(0, &window, [&window] { window.projects().offerRecovery(); });
    const int code = QApplication::exec();
    keepClipboard();
    application.setMessageHandler({});
    return code;
}
