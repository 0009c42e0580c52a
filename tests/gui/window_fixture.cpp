#include "window_fixture.hpp"

#include <QAction>
#include <QApplication>
#include <QSettings>
#include <QTemporaryDir>
#include <QTest>

namespace jet::test {

namespace {

/// One application for all tests of the process.
class QtEnvironment final : public testing::Environment {
public:
    void SetUp() override
    {
        qputenv("QT_QPA_PLATFORM",
                qEnvironmentVariableIsSet("JET_TEST_PLATFORM") ? qgetenv("JET_TEST_PLATFORM") : "offscreen");
        qputenv("XDG_STATE_HOME", state_.path().toUtf8());  // the journals of these tests are nobody else's
        application_ = std::make_unique<QApplication>(count_, arguments_);
    }
    void TearDown() override { application_.reset(); }

private:
    int count_ = 1;
    char name_[13] = "jet-gui-test";
    char* arguments_[2] = {name_, nullptr};
    QTemporaryDir state_;
    std::unique_ptr<QApplication> application_;
};

[[maybe_unused]] testing::Environment* const environment = testing::AddGlobalTestEnvironment(new QtEnvironment);

}  // namespace

WindowFixture::WindowFixture()
    : WindowFixture(
          {"org.jet.tool.selection", "org.jet.tool.rectangle", "org.jet.tool.ellipse", "org.jet.effect.polygon-face"})
{
}

WindowFixture::WindowFixture(std::initializer_list<std::string_view> plugins) : catalog_(plugins)
{
    QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder_.path() + "/settings");
    start();
}

WindowFixture::~WindowFixture() { stop(); }

void WindowFixture::start()
{
    stop();
    window_ = std::make_unique<host::MainWindow>(launch_);
    window_->projects().setQuestion([] { return host::ProjectController::Answer::Discard; });
    window_->projects().setRecoveryQuestion([](const auto&) { return host::RecoveryChoice{}; });
    window_->restoreSettings();
    window_->projects().create();
    window_->resize(1000, 700);
    window_->show();
    QApplication::processEvents();
    if (host::SceneView* front = window_->documents().currentView()) front->setView(View{});
}

void WindowFixture::stop()
{
    if (!window_) return;
    window_->close();
    window_.reset();
    QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
}

void WindowFixture::trigger(const char* action)
{
    window_->actionTable().refresh();
    window_->actionTable().find(action)->trigger();
    QApplication::processEvents();
}

bool WindowFixture::isEnabled(const char* action)
{
    window_->actionTable().refresh();
    return window_->actionTable().find(action)->isEnabled();
}

void WindowFixture::key(int key, Qt::KeyboardModifiers modifiers)
{
    view().setFocus();
    QTest::keyClick(&view(), static_cast<Qt::Key>(key), modifiers);
}

void WindowFixture::drag(const QPoint& from, const QPoint& to, Qt::MouseButton button)
{
    // QTest::mouseMove() does not report held buttons: the view would take a drag for a hover.
    const auto send = [&](QEvent::Type type, const QPoint& at, Qt::MouseButton changed, Qt::MouseButtons held) {
        QMouseEvent event(type, at, view().mapToGlobal(at), changed, held, Qt::NoModifier);
        QApplication::sendEvent(&view(), &event);
    };
    send(QEvent::MouseButtonPress, from, button, button);
    send(QEvent::MouseMove, (from + to) / 2, Qt::NoButton, button);
    send(QEvent::MouseMove, to, Qt::NoButton, button);
    send(QEvent::MouseButtonRelease, to, button, Qt::NoButton);
}

void WindowFixture::draw(const char* tool, const QPoint& from, const QPoint& to)
{
    window_->setActiveTool(tool);
    drag(from, to);
}

std::vector<const Item*> WindowFixture::shapes()
{
    std::vector<const Item*> found;
    scene().root().walk([&](const Item& item) {
        if (item.is<ShapeItem>()) found.push_back(&item);
    });
    return found;
}

}  // namespace jet::test
