#include "window_fixture.hpp"

#include <jet/ui/panel.hpp>

#include <QApplication>
#include <QDockWidget>
#include <QLabel>
#include <QSettings>

namespace jet::test {

namespace {

class LabelPanel final : public Panel {
public:
    using Panel::Panel;
    QWidget* createWidget() override { return new QLabel("here"); }
};

}  // namespace

/// The built panels, and what they look like from run to run.
class LayoutTest : public WindowFixture {
protected:
    LayoutTest() : WindowFixture({"org.jet.panel.layers", "org.jet.panel.output", "org.jet.panel.inspector"}) {}

    QDockWidget* dock(const char* panel) { return window().findChild<QDockWidget*>(QStringLiteral("panel:") + panel); }
};

TEST_F(LayoutTest, ShownPanelsAreFilled)
{
    for (const char* panel : {"layers", "output", "inspector"}) {
        ASSERT_NE(dock(panel), nullptr) << panel;
        EXPECT_NE(dock(panel)->widget(), nullptr) << panel;
    }
    EXPECT_EQ(window().dockWidgetArea(dock("output")), Qt::BottomDockWidgetArea);
    EXPECT_EQ(window().dockWidgetArea(dock("layers")), Qt::RightDockWidgetArea);
}

TEST_F(LayoutTest, AMovedPanelIsWhereItWasAtTheNextStart)
{
    window().addDockWidget(Qt::LeftDockWidgetArea, dock("layers"));
    dock("output")->hide();
    start();
    EXPECT_EQ(window().dockWidgetArea(dock("layers")), Qt::LeftDockWidgetArea);
    EXPECT_TRUE(dock("output")->isHidden());
}

TEST_F(LayoutTest, MaximizingHidesThePanelsAndBringsThemBack)
{
    trigger("view.maximize");
    EXPECT_TRUE(dock("layers")->isHidden());
    trigger("view.maximize");
    EXPECT_FALSE(dock("layers")->isHidden());
}

/// A panel whose plugin comes, goes and comes back.
class AbsentPanelTest : public testing::Test {
protected:
    Qt::DockWidgetArea run(bool installed, Qt::DockWidgetArea moveTo = Qt::NoDockWidgetArea)
    {
        EventsCenter events;
        TestCatalog catalog;
        catalog.inCode().panel<LabelPanel>("first");
        if (installed) catalog.inCode().panel<LabelPanel>("second");
        host::MainWindow window({catalog, events, {}, false, {}});
        window.restoreSettings();
        window.projects().create();
        window.show();
        QApplication::processEvents();
        auto* second = window.findChild<QDockWidget*>("panel:second");
        if (!installed) {
            EXPECT_TRUE(second->isHidden());
        }
        if (moveTo != Qt::NoDockWidgetArea) window.addDockWidget(moveTo, second);
        const Qt::DockWidgetArea area = window.dockWidgetArea(second);
        const bool shown = !second->isHidden();
        window.close();
        return shown || !installed ? area : Qt::NoDockWidgetArea;
    }

    QTemporaryDir folder_;
};

TEST_F(AbsentPanelTest, KeepsItsPlace)
{
    QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder_.path());
    run(true, Qt::BottomDockWidgetArea);
    run(false);
    run(false);
    EXPECT_EQ(run(true), Qt::BottomDockWidgetArea);
}

}  // namespace jet::test
