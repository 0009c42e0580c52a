#include "inspector/inspector_widget.hpp"
#include "physics-debug/physics_widget.hpp"
#include "window_fixture.hpp"

#include <jet/rewind.hpp>

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QSlider>
#include <QTableWidget>
#include <QTest>

namespace jet::test {

class PhysicsPanelTest : public WindowFixture {
protected:
    PhysicsPanelTest()
        : WindowFixture({"org.jet.tool.rectangle", "org.jet.physics", "org.jet.effect.in-path-rigid-body"})
    {
        draw("rectangle", {100, 100}, {150, 150});
        draw("rectangle", {50, 300}, {400, 330});
        const std::vector<const Item*> drawn = shapes();
        auto edit = scene().items().begin("Bodies");
        for (const Item* item : drawn) edit.addEffect(*item, "in-path-rigid-body");
        edit.set(*drawn[1], "fixed", true);
        edit.commit();
        panel_ = std::make_unique<panels::PhysicsWidget>(window());
        panel_->resize(300, 500);
        panel_->show();
    }
    ~PhysicsPanelTest() override { simulation().stop(); }
    SimulationCenter& simulation() { return window().simulation(); }
    bool eventually(const std::function<bool()>& holds) { return QTest::qWaitFor(holds, 20000); }
    bool hasPixel(QRgb color)
    {
        const QImage image = view().grab().toImage().convertToFormat(QImage::Format_RGB32);
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x)
                if (image.pixel(x, y) == color) return true;
        return false;
    }
    QString number(int row) { return panel_->findChild<QTableWidget*>("numbers")->item(row, 1)->text(); }

    std::unique_ptr<panels::PhysicsWidget> panel_;
};

TEST_F(PhysicsPanelTest, BoxesSetTheMarksAndFollowThem)
{
    panel_->findChild<QCheckBox*>("contacts")->setChecked(true);
    EXPECT_TRUE(simulation().physicsMarks().contacts);
    PhysicsMarks marks;
    marks.islands = true;
    simulation().setPhysicsMarks(marks);
    EXPECT_FALSE(panel_->findChild<QCheckBox*>("contacts")->isChecked());
    EXPECT_TRUE(panel_->findChild<QCheckBox*>("islands")->isChecked());
}

TEST_F(PhysicsPanelTest, MarksAreDrawnOverTheGame)
{
    trigger("play.play");
    PhysicsMarks marks = panels::allMarks();
    simulation().setPhysicsMarks(marks);
    ASSERT_TRUE(eventually([&] {
        const auto frame = simulation().frame();
        return frame && frame->physics && !frame->physics->contacts.empty();
    })) << "the box lands on the ground";
    simulation().pause();
    const QRgb contact = qRgb(220, 40, 40);
    EXPECT_TRUE(eventually([&] { return hasPixel(contact); }));
    if (const QString folder = qEnvironmentVariable("JET_SCREENSHOTS"); !folder.isEmpty()) {
        QTest::qWait(300);
        window().grab().save(folder + "/physics-marks.png");
        panel_->grab().save(folder + "/physics-panel.png");
    }
    simulation().setPhysicsMarks({});
    EXPECT_TRUE(eventually([&] { return !hasPixel(contact); }));
}

TEST_F(PhysicsPanelTest, NumbersAreMadeOnlyWhileThePanelIsSeen)
{
    trigger("play.play");
    EXPECT_TRUE(eventually([&] { return number(0) == "2"; }));
    panel_->hide();
    EXPECT_FALSE(simulation().physicsMarks().any());
    ASSERT_TRUE(eventually([&] { return simulation().frame() && !simulation().frame()->physics; }));
}

TEST_F(PhysicsPanelTest, TheSliderPausesAndGoesBack)
{
    trigger("play.play");
    ASSERT_TRUE(eventually([&] { return simulation().frame() && simulation().frame()->step > 30; }));
    auto* slider = panel_->findChild<QSlider*>("rewind");
    ASSERT_TRUE(eventually([&] { return slider->isEnabled() && slider->value() > 10; }));
    slider->setValue(5);
    EXPECT_EQ(simulation().state(), SimulationCenter::State::Paused);
    EXPECT_TRUE(eventually([&] { return simulation().frame()->step == 5; }));
    EXPECT_TRUE(eventually([&] { return panel_->findChild<QLabel*>("rewind-time")->text().contains("step 5"); }));
    trigger("play.play");
    EXPECT_TRUE(eventually([&] { return simulation().frame()->step > 10; })) << "it plays on from there";
}

TEST_F(PhysicsPanelTest, TheSceneChoosesAmongTheInstalledEnginesAndKeepsOneThatIsNot)
{
    scene().items().setSelection({});
    inspector::InspectorWidget inspector(window());
    inspector.show();
    QComboBox* engines = nullptr;
    ASSERT_TRUE(eventually([&] {
        const auto* editor = inspector.findChild<QWidget*>("physics");
        engines = editor ? editor->findChild<QComboBox*>() : nullptr;
        return engines != nullptr;
    }));
    EXPECT_EQ(engines->currentData().toString(), "") << "the first one installed";
    const int jet = engines->findData("jet-physics");
    ASSERT_GE(jet, 0);
    engines->setCurrentIndex(jet);
    emit engines->activated(jet);
    EXPECT_EQ(scene().setting("physics").as<std::string>(), "jet-physics");
    auto edit = scene().items().begin("Another engine");
    edit.setScene("physics", "acme-physics");
    edit.commit();
    EXPECT_TRUE(eventually([&] {
        const auto* box = inspector.findChild<QWidget*>("physics")->findChild<QComboBox*>();
        return box->currentData().toString() == "acme-physics";
    }));
}

}  // namespace jet::test
