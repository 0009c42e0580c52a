#include "inspector/inspector_widget.hpp"
#include "window_fixture.hpp"

#include <QAbstractSpinBox>
#include <QCheckBox>
#include <QLineEdit>
#include <QTest>

namespace jet::test {

class InspectorTest : public WindowFixture {
protected:
    InspectorTest()
    {
        draw("rectangle", {100, 100}, {150, 150});
        draw("rectangle", {200, 100}, {250, 150});
        inspector_ = std::make_unique<inspector::InspectorWidget>(window());
        inspector_->resize(300, 600);
        inspector_->show();
    }
    /// The Inspector follows a little later; on a busy machine, much later.
    static bool eventually(const std::function<bool()>& holds) { return QTest::qWaitFor(holds, 10000); }
    ui::PropertyEditor* editor(const char* property)
    {
        for (ui::PropertyForm* form : inspector_->findChildren<ui::PropertyForm*>()) {
            if (!form->isVisible()) continue;
            if (auto* found = dynamic_cast<ui::PropertyEditor*>(form->findChild<QWidget*>(property))) return found;
        }
        return nullptr;
    }

    std::unique_ptr<inspector::InspectorWidget> inspector_;
};

TEST_F(InspectorTest, ShowsTheSelectedItemAndRenamesIt)
{
    auto* name = editor("name")->findChild<QLineEdit*>();
    EXPECT_EQ(name->text().toStdString(), shapes().back()->name());
    name->selectAll();
    QTest::keyClicks(name, "Ball");
    QTest::keyClick(name, Qt::Key_Return);
    EXPECT_EQ(shapes().back()->name(), "Ball");
    scene().undoRedo().undo();
    EXPECT_TRUE(eventually([&] { return editor("name")->findChild<QLineEdit*>()->text() != "Ball"; }));
}

TEST_F(InspectorTest, DifferingValuesAreBlankAndOneEditSetsAll)
{
    scene().items().setSelection({shapes()[0]->id(), shapes()[1]->id()});
    ASSERT_TRUE(eventually([&] { return editor("name")->findChild<QLineEdit*>()->text().isEmpty(); }));
    editor("locked")->findChild<QCheckBox*>()->click();
    EXPECT_TRUE(shapes()[0]->locked());
    EXPECT_TRUE(shapes()[1]->locked());
    scene().undoRedo().undo();
    EXPECT_FALSE(shapes()[0]->locked());
}

TEST_F(InspectorTest, SpinningAValueIsOneUndoStep)
{
    const std::uint64_t before = scene().hash();
    auto* x = editor("position")->findChild<QAbstractSpinBox*>();
    for (int i = 0; i < 5; ++i) {
        const double from = shapes().back()->bounds().min.x();
        x->stepUp();
        EXPECT_GT(shapes().back()->bounds().min.x(), from);
    }
    EXPECT_NE(scene().hash(), before);
    scene().undoRedo().undo();
    EXPECT_EQ(scene().hash(), before);
}

TEST_F(InspectorTest, WhatLiesInASelectedGroupIsMovedOnceOnly)
{
    auto edit = scene().items().begin("Group");
    const Item& group = edit.add<GroupItem>(*shapes()[0]->parent());
    const Item& inner = *shapes()[0];
    edit.move(inner, group, 0);
    edit.setSelection({group.id(), inner.id()});
    edit.commit();
    ASSERT_TRUE(eventually([&] { return editor("position") != nullptr && editor("name") != nullptr; }));
    QTest::qWait(100);
    auto* x = editor("position")->findChild<QAbstractSpinBox*>();
    x->selectAll();
    QTest::keyClicks(x, "300");
    QTest::keyClick(x, Qt::Key_Return);
    EXPECT_NEAR(inner.bounds().min.x(), 300, 1e-9);
}

TEST_F(InspectorTest, ABurstOfChangesIsShownOnceAtItsEnd)
{
    auto* name = editor("name")->findChild<QLineEdit*>();
    int shown = 0;
    QObject::connect(name, &QLineEdit::textChanged, [&] { ++shown; });
    for (int i = 0; i < 1000; ++i) {
        auto edit = scene().items().begin("Rename");
        edit.set(*shapes().back(), "name", "Name " + std::to_string(i));
        edit.commit();
    }
    EXPECT_EQ(shown, 0);
    EXPECT_TRUE(eventually([&] { return name->text() == "Name 999"; }));
    EXPECT_EQ(shown, 1);
}

TEST_F(InspectorTest, ExactNumbersAreKeptAndOutOfRangeIsBounded)
{
    scene().items().setSelection({});
    ASSERT_TRUE(eventually([&] { return editor("time-step") != nullptr; }));
    auto* step = editor("time-step")->findChild<QAbstractSpinBox*>();
    const auto enter = [&](const char* number) {
        step->selectAll();
        QTest::keyClicks(step, number);
        QTest::keyClick(step, Qt::Key_Return);
        QTest::qWait(80);
        return scene().setting("time-step").as<double>();
    };
    EXPECT_EQ(enter("0.0125"), 0.0125);
    EXPECT_EQ(enter("7"), 1);  // at most a second a step
    EXPECT_EQ(enter("0,5"), 0.5);
}

TEST_F(InspectorTest, NumberFieldsCalculateAndShowWhatIsWrongBesideThem)
{
    scene().items().setSelection({});
    ASSERT_TRUE(eventually([&] { return editor("time-step") != nullptr; }));
    auto* step = editor("time-step")->findChild<QAbstractSpinBox*>();
    const auto enter = [&](const char* text) {
        step->selectAll();
        QTest::keyClicks(step, text);
        QTest::keyClick(step, Qt::Key_Return);
        return scene().setting("time-step").as<double>();
    };
    EXPECT_EQ(enter("1/4"), 0.25);
    EXPECT_EQ(enter("50%"), 0.125);
    EXPECT_EQ(enter("20 ms"), 0.02);
    EXPECT_EQ(enter("20 mm"), 0.02);
    EXPECT_EQ(step->toolTip().toStdString(), "\"mm\" is no unit of this field; it takes s, ms, min.");
    EXPECT_EQ(step->findChild<QLineEdit*>()->text().toStdString(), "20 mm") << "what was typed stays, to be mended";
    EXPECT_EQ(enter("0.5"), 0.5);
    EXPECT_NE(step->toolTip().toStdString(), "\"mm\" is no unit of this field; it takes s, ms, min.");
}

TEST_F(InspectorTest, ItemsOfSeveralTypesAreEditedInWhatTheyHaveInCommon)
{
    ItemId spring, rspring;
    {
        auto edit = scene().items().begin("Springs");
        spring = edit.add<SpringItem>(scene().root(), Path::line({0, 0}, {10, 0})).id();
        rspring = edit.add<RSpringItem>(scene().root(), Path::line({0, 0}, {10, 0})).id();
        const ItemId sound = edit.add<SoundItem>(scene().root()).id(), image = edit.add<ImageItem>(scene().root()).id();
        edit.setSelection({sound, image});
        edit.commit();
    }
    ASSERT_TRUE(eventually([&] { return editor("file") != nullptr; }));
    EXPECT_EQ(editor("volume"), nullptr);
    auto* file = editor("file")->findChild<QLineEdit*>();
    QTest::keyClicks(file, "a.dat");
    QTest::keyClick(file, Qt::Key_Return);
    for (const ItemId id : scene().items().selection())
        EXPECT_EQ(scene().items().find(id)->property("file"), Value("a.dat"));
    scene().items().setSelection({spring, rspring});
    EXPECT_TRUE(eventually([&] { return editor("file") == nullptr; }));
    EXPECT_EQ(editor("ks"), nullptr) << "force/unit is not torque/rad";
}

TEST_F(InspectorTest, ThePartsOfVectorsThatDifferAreEditedOneByOne)
{
    std::vector<ItemId> bodies;
    {
        auto edit = scene().items().begin("Bodies");
        for (const Vec2& velocity : {Vec2(1, 2), Vec2(1, 3)}) {
            const Item& body = edit.add<BodyItem>(scene().root());
            edit.set(body, "velocity", velocity);
            bodies.push_back(body.id());
        }
        edit.setSelection(bodies);
        edit.commit();
    }
    const auto velocityOf = [&](std::size_t i) {
        return scene().items().find(bodies[i])->property("velocity")->as<Vec2>();
    };
    const auto part = [&](int i) { return editor("velocity")->findChildren<QAbstractSpinBox*>().at(i); };
    const auto shown = [&](int i) { return part(i)->text().section(' ', 0, 0).toStdString(); };  // without its unit
    ASSERT_TRUE(eventually([&] { return editor("velocity") != nullptr && shown(0) == "1"; }));
    EXPECT_EQ(shown(1), "") << "y differs";
    const auto enter = [&](int i, const char* number) {
        part(i)->selectAll();
        QTest::keyClicks(part(i), number);
        QTest::keyClick(part(i), Qt::Key_Return);
    };
    enter(0, "7");
    EXPECT_EQ(velocityOf(0), Vec2(7, 2));
    EXPECT_EQ(velocityOf(1), Vec2(7, 3));
    enter(1, "5");
    EXPECT_EQ(velocityOf(0), Vec2(7, 5));
    EXPECT_EQ(velocityOf(1), Vec2(7, 5));
    scene().undoRedo().undo();
    scene().undoRedo().undo();
    EXPECT_EQ(velocityOf(0), Vec2(1, 2));
    EXPECT_EQ(velocityOf(1), Vec2(1, 3));
}

TEST_F(InspectorTest, TheFrameOfATextFollowsItsLettersInTheSameStep)
{
    ItemId id;
    {
        auto edit = scene().items().begin("Text");
        const Item& text = edit.add<TextItem>(scene().root(), Path::rectangle(Box({10, 10}, {60, 40})));
        edit.select(text);
        edit.commit();
        id = text.id();
    }
    ASSERT_TRUE(eventually([&] { return editor("size") && editor("font"); }));
    const std::uint64_t before = scene().hash();
    auto* size = editor("font")->parentWidget()->findChild<QWidget*>("size")->findChild<QAbstractSpinBox*>();
    ASSERT_NE(size, nullptr) << "that of the letters, not that of the box";
    size->selectAll();
    QTest::keyClicks(size, "48");
    QTest::keyClick(size, Qt::Key_Return);
    const Item& text = *scene().items().find(id);
    EXPECT_NEAR(text.bounds().height(), 1.2 * 48, 1e-9);
    EXPECT_EQ(text.bounds().min, Vec2(10, 10));
    scene().undoRedo().undo();
    EXPECT_EQ(scene().hash(), before);
}

TEST_F(InspectorTest, WithNothingSelectedTheSceneIsShown)
{
    EXPECT_EQ(editor("gravity"), nullptr);
    scene().items().setSelection({});
    EXPECT_TRUE(eventually([&] { return editor("gravity") != nullptr; }));
}

}  // namespace jet::test
