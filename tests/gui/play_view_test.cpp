// A playing scene under the mouse: bodies that are dragged, and games that want the mouse for themselves.
#include "canvas/play_view.hpp"
#include "support/test_catalog.hpp"

#include <jet/rewind.hpp>

#include <QApplication>
#include <QMouseEvent>
#include <QTest>

#include <gtest/gtest.h>

#include <functional>

namespace jet::test {

namespace {

/// One application for all tests of the process.
class QtEnvironment final : public testing::Environment {
public:
    void SetUp() override
    {
        qputenv("QT_QPA_PLATFORM",
                qEnvironmentVariableIsSet("JET_TEST_PLATFORM") ? qgetenv("JET_TEST_PLATFORM") : "offscreen");
        application_ = std::make_unique<QApplication>(count_, arguments_);
    }
    void TearDown() override { application_.reset(); }

private:
    int count_ = 1;
    char name_[14] = "jet-play-test";
    char* arguments_[2] = {name_, nullptr};
    std::unique_ptr<QApplication> application_;
};

[[maybe_unused]] testing::Environment* const environment = testing::AddGlobalTestEnvironment(new QtEnvironment);

}  // namespace

class PlayViewTest : public testing::Test {
protected:
    PlayViewTest() : scene_("One", events_, catalog_)
    {
        body(Path::rectangle({{50, 300}, {400, 330}}), "in-path-rigid-body", true);
        box_ = body(Path::rectangle({{100, 260}, {140, 300}}), "in-path-rigid-body");
        ball_ = body(Path::ellipse({{240, 220}, {300, 280}}), "in-path-body");
        window_.resize(600, 400);
        events_.setWakeUp([this] { QMetaObject::invokeMethod(&window_, [this] { events_.dispatchQueued(); }); });
    }
    ~PlayViewTest() override
    {
        simulation_.stop();
        events_.setWakeUp({});
    }

    ItemId body(Path path, const char* effect, bool fixed = false)
    {
        auto edit = scene_.items().begin("Body");
        const Item& item = edit.add<ShapeItem>(scene_.root(), std::move(path));
        edit.addEffect(item, "polygon-face");
        edit.addEffect(item, effect);
        edit.set(item, "fixed", fixed);
        edit.commit();
        return item.id();
    }
    SimulationCenter& simulation() { return simulation_; }
    host::PlayView* game() { return game_; }
    static bool eventually(const std::function<bool()>& holds) { return QTest::qWaitFor(holds, 20000); }
    void script(const char* code)
    {
        auto edit = scene_.items().begin("Script");
        const Item& item = edit.add<ScriptItem>(scene_.root());
        edit.set(item, "code", std::string(code));
        edit.commit();
    }
    void play()
    {
        SimulationOptions options;
        options.sceneByName = [this](std::string_view) { return &scene_; };
        simulation_.play(scene_, options).orThrow();
        delete game_;
        game_ = new host::PlayView(simulation_, events_, View{}, &window_);
        window_.show();
        game_->setFocus();
        ASSERT_TRUE(eventually([&] { return simulation().frame() && simulation().frame()->step >= 2; }));
    }
    void send(QEvent::Type type, const QPoint& at, Qt::MouseButton button, Qt::MouseButtons buttons,
              Qt::KeyboardModifiers modifiers = Qt::NoModifier)
    {
        QMouseEvent event(type, at, game()->mapToGlobal(at), button, buttons, modifiers);
        QApplication::sendEvent(game(), &event);
    }
    void press(const QPoint& at, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
    {
        send(QEvent::MouseButtonPress, at, Qt::LeftButton, Qt::LeftButton, modifiers);
    }
    void move(const QPoint& at, Qt::MouseButtons buttons = Qt::LeftButton)
    {
        send(QEvent::MouseMove, at, Qt::NoButton, buttons);
    }
    void release(const QPoint& at) { send(QEvent::MouseButtonRelease, at, Qt::LeftButton, Qt::NoButton); }
    bool holds()
    {
        return eventually([&] { return simulation().held().has_value(); });
    }
    bool letsGo()
    {
        return eventually([&] { return !simulation().held(); });
    }
    Vec2 place(ItemId item)
    {
        for (const auto& [id, path] : simulation().frame()->poses)
            if (id == item) return path.bounds().center();
        return {0, 0};
    }
    std::string printed()
    {
        std::string all;
        for (const std::string& line : lines_) all += line + "\n";
        return all;
    }
    bool hasPixel(QRgb color)
    {
        const QImage image = game()->grab().toImage().convertToFormat(QImage::Format_RGB32);
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x)
                if (image.pixel(x, y) == color) return true;
        return false;
    }
    void listen()
    {
        lines_.clear();
        output_ = events_.subscribe<OutputPrinted>(
            nullptr, [this](const OutputPrinted& event) { lines_.push_back(event.line.text); });
    }

    TestCatalog catalog_{"org.jet.physics", "org.jet.script-duktape", "org.jet.effect.in-path-body",
                         "org.jet.effect.in-path-rigid-body", "org.jet.effect.polygon-face"};
    EventsCenter events_;
    Scene scene_;
    SimulationCenter simulation_{events_};
    QWidget window_;
    host::PlayView* game_ = nullptr;
    ItemId box_, ball_;
    std::vector<std::string> lines_;
    Subscription output_;
    const QRgb band_ = qRgb(0, 120, 90);
};

TEST_F(PlayViewTest, ABodyFollowsThePointerAndFliesOnWhenItIsLetGo)
{
    play();
    press({120, 280});
    ASSERT_TRUE(holds());
    EXPECT_EQ(simulation().held()->item, box_);
    EXPECT_TRUE(eventually([&] { return game()->cursor().shape() == Qt::ClosedHandCursor; }));
    move({200, 120});
    ASSERT_TRUE(eventually([&] { return (place(box_) - Vec2(200, 120)).norm() < 8; }));
    move({200, 60});
    EXPECT_TRUE(eventually([&] { return place(box_).y() < 90; }));
    release({200, 60});
    ASSERT_TRUE(letsGo());
    EXPECT_EQ(game()->cursor().shape(), Qt::ArrowCursor);
    EXPECT_TRUE(eventually([&] { return place(box_).y() < 50; })) << "it flies on";
}

TEST_F(PlayViewTest, ABandIsDrawnFromTheBodyToThePointer)
{
    play();
    simulation().pause();
    const auto held = place(ball_);
    press({static_cast<int>(held.x()), static_cast<int>(held.y())});
    ASSERT_TRUE(holds());
    EXPECT_EQ(simulation().held()->item, ball_);
    move({340, 100});
    ASSERT_TRUE(eventually([&] { return simulation().held()->hand == Vec2(340, 100); }));
    EXPECT_TRUE(hasPixel(band_));
    if (const QString folder = qEnvironmentVariable("JET_SCREENSHOTS"); !folder.isEmpty()) {
        simulation().resume();
        QTest::qWait(60);
        window_.grab().save(folder + "/dragging.png");
    }
    release({340, 100});
    ASSERT_TRUE(letsGo());
    EXPECT_FALSE(hasPixel(band_));
}

TEST_F(PlayViewTest, PausedItIsHeldAndMovesOnSingleSteps)
{
    play();
    simulation().pause();
    press({120, 280});
    ASSERT_TRUE(holds());
    move({200, 100});
    const Vec2 before = place(box_);
    for (int i = 0; i < 30; ++i) {
        const std::uint64_t next = simulation().frame()->step + 1;
        simulation().singleStep();
        ASSERT_TRUE(eventually([&] { return simulation().frame()->step == next; }));
    }
    EXPECT_LT(place(box_).y(), before.y() - 80);
    EXPECT_TRUE(simulation().held());
    release({200, 100});
    EXPECT_TRUE(letsGo());
}

TEST_F(PlayViewTest, ItIsLetGoWhenTheFocusLeavesOrTheReleaseWasLost)
{
    play();
    press({120, 280});
    ASSERT_TRUE(holds());
    QFocusEvent out(QEvent::FocusOut, Qt::ActiveWindowFocusReason);
    QApplication::sendEvent(game(), &out);
    ASSERT_TRUE(letsGo());
    const Vec2 box = place(box_);
    press({static_cast<int>(box.x()), static_cast<int>(box.y())});
    ASSERT_TRUE(holds());
    move({300, 100}, Qt::NoButton);
    ASSERT_TRUE(letsGo());
    EXPECT_EQ(game()->cursor().shape(), Qt::ArrowCursor);
}

TEST_F(PlayViewTest, OutsideOfTheViewTheHandStaysAtItsBorder)
{
    play();
    press({120, 280});
    ASSERT_TRUE(holds());
    move({-500, 99999});
    EXPECT_TRUE(eventually([&] { return simulation().held()->hand == Vec2(0, game()->height()); }));
    release({-500, 99999});
    EXPECT_TRUE(letsGo());
}

TEST_F(PlayViewTest, NothingIsHeldAfterStopAndAfterGoingBack)
{
    play();
    press({120, 280});
    ASSERT_TRUE(holds());
    move({200, 100});
    ASSERT_TRUE(eventually([&] { return place(box_).y() < 150; }));
    simulation().rewindTo(0);
    ASSERT_TRUE(eventually([&] { return simulation().frame()->step == 0; }));
    EXPECT_FALSE(simulation().held());
    EXPECT_NEAR(place(box_).y(), 280, 1);
    move({300, 100});  // the button is still down
    simulation().resume();
    ASSERT_TRUE(eventually([&] { return simulation().frame()->step > 20; }));
    EXPECT_NEAR(place(box_).y(), 280, 1);
    EXPECT_EQ(game()->cursor().shape(), Qt::ArrowCursor);
    release({300, 100});
    press({120, 280});
    ASSERT_TRUE(holds());
    simulation().stop();
    EXPECT_FALSE(simulation().held());
    play();
    EXPECT_FALSE(simulation().held());
}

TEST_F(PlayViewTest, TheMouseIsTheGamesWhereItListensAndCtrlDragsForTheEditor)
{
    script("['onPointerDown', 'onPointerMove', 'onPointerUp'].forEach(function (type) {"
           "    JetSystem.addEventListener(type, function (event) { print(event.type); });"
           "});");
    listen();
    play();
    EXPECT_TRUE(simulation().listensToPointer());
    press({120, 280});
    move({200, 200});
    release({200, 200});
    ASSERT_TRUE(eventually([&] { return lines_.size() >= 3; }));
    EXPECT_EQ(printed(), "onPointerDown\nonPointerMove\nonPointerUp\n");
    EXPECT_FALSE(simulation().held());
    lines_.clear();
    press({120, 280}, Qt::ControlModifier);
    ASSERT_TRUE(holds());
    EXPECT_EQ(simulation().held()->item, box_);
    move({200, 200});
    send(QEvent::MouseButtonPress, {200, 200}, Qt::RightButton, Qt::LeftButton | Qt::RightButton);
    send(QEvent::MouseButtonRelease, {200, 200}, Qt::RightButton, Qt::LeftButton);
    release({200, 200});
    ASSERT_TRUE(letsGo());
    const std::uint64_t then = simulation().frame()->step;
    ASSERT_TRUE(eventually([&] { return simulation().frame()->step > then + 5; }));
    EXPECT_EQ(printed(), "") << "it heard nothing of that drag";
    move({210, 200}, Qt::NoButton);
    EXPECT_TRUE(eventually([&] { return printed() == "onPointerMove\n"; })) << "of the next it does";
}

TEST_F(PlayViewTest, AGameThatBeginsToListenGetsTheNextDrag)
{
    script("JetSystem.addEventListener('onKeyDown', function () {"
           "    JetSystem.addEventListener('onPointerDown', function () { print('mine'); });"
           "});");
    listen();
    play();
    EXPECT_FALSE(simulation().listensToPointer());
    press({120, 280});
    ASSERT_TRUE(holds());
    release({120, 280});
    ASSERT_TRUE(letsGo());
    QTest::keyClick(game(), Qt::Key_Space);
    ASSERT_TRUE(eventually([&] { return simulation().listensToPointer(); }));
    press({120, 280});
    release({120, 280});
    EXPECT_TRUE(eventually([&] { return printed() == "mine\n"; }));
    EXPECT_FALSE(simulation().held());
}

TEST_F(PlayViewTest, AnotherSceneThatAScriptGoesToHoldsNothing)
{
    script("JetSystem.addEventListener('onKeyDown', function () { JetSystem.playScene('One'); });");
    play();
    press({120, 280});
    ASSERT_TRUE(holds());
    move({200, 100});
    ASSERT_TRUE(eventually([&] { return place(box_).y() < 150; }));
    QTest::keyClick(game(), Qt::Key_Space);
    ASSERT_TRUE(eventually([&] { return simulation().frame() && place(box_).y() > 250 && !simulation().held(); }));
    move({220, 100});
    const std::uint64_t then = simulation().frame()->step;
    ASSERT_TRUE(eventually([&] { return simulation().frame()->step > then + 10; }));
    EXPECT_FALSE(simulation().held());
    release({220, 100});
}

}  // namespace jet::test
