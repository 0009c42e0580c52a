#include "window/launch.hpp"

#include "window/crash_dialog.hpp"
#include "window/guarded_application.hpp"
#include "window/main_window.hpp"
#include "window/theme.hpp"

#include <QApplication>
#include <QEvent>
#include <QTimer>

#include <clocale>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iterator>
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

int jet_run_window(int argc, char** argv, const jet::host::WindowLaunch& launch)
{
    jet::host::GuardedApplication application(argc, argv, launch.runtime);
    std::setlocale(LC_NUMERIC, "C");  // QApplication sets the user's: numbers in files and scripts have a point
    QApplication::setApplicationName("JET");
    QApplication::setDesktopFileName("jet");
    jet::host::applyTheme(application);
    if (!launch.crashes.empty()) {
        jet::host::CrashDialog dialog(launch.crashes);
        if (dialog.exec() == QDialog::Rejected) return 0;
        if (launch.goOnWithout) launch.goOnWithout(dialog.leftOut());
    }
    jet::host::MainWindow window(launch);
    application.setMessageHandler([&window](const std::string& message) { window.showMessage(message); });
    window.restoreSettings();
    if (launch.project.empty() || !window.projects().open(launch.project)) window.projects().create();
    FirstFrame firstFrame;
    if (qEnvironmentVariableIsSet("JET_TRACE_FIRST_FRAME")) application.installEventFilter(&firstFrame);
    window.show();
    // What a crash left of other projects is offered once the window is there; opening one offers its own.
    if (launch.project.empty()) QTimer::singleShot(0, &window, [&window] { window.projects().offerRecovery(); });
    const int code = QApplication::exec();
    application.setMessageHandler({});
    return code;
}
