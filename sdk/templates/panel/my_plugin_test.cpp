#include <jet/testing/gtest.hpp>
#include <jet/ui/panel.hpp>

#include <QApplication>
#include <QLabel>
#include <QPushButton>

namespace {

/// Widgets need an application; ctest runs it without a display (QT_QPA_PLATFORM=offscreen).
QApplication& application()
{
    static int count = 1;
    static char name[] = "my-plugin-test";
    static char* arguments[] = {name, nullptr};
    static QApplication one(count, arguments);
    return one;
}

class MyPluginTest : public jet::test::PluginTest {
protected:
    MyPluginTest() : PluginTest{"org.example.my-plugin"}
    {
        application();
        panel_ = catalog().createPanel("my-plugin", editor());
        widget_.reset(panel_->createWidget());
    }
    QString count() const { return widget_->findChild<QLabel*>("count")->text(); }
    QPushButton& button() { return *widget_->findChild<QPushButton*>("select"); }

private:
    std::unique_ptr<jet::Panel> panel_;
    std::unique_ptr<QWidget> widget_;
};

TEST_F(MyPluginTest, CountsTheShapesAsTheyComeAndGo)
{
    EXPECT_EQ(count(), "Shapes: 0");
    addRectangle({{0, 0}, {10, 10}});
    EXPECT_EQ(count(), "Shapes: 1");
    undo();
    EXPECT_EQ(count(), "Shapes: 0");
}

TEST_F(MyPluginTest, TheButtonSelectsAllShapes)
{
    EXPECT_FALSE(button().isEnabled());
    addRectangle({{0, 0}, {10, 10}});
    addRectangle({{20, 0}, {30, 10}});
    button().click();
    EXPECT_EQ(scene().selected(), scene().shapes());
}

}  // namespace
