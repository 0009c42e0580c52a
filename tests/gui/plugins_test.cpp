// Plugins in the window: settings, what is missing, and the Plugins panel, over a plugin manager with the fixtures.
#include "../host/plugins/plugin_folder.hpp"
#include "host/plugins/plugin_control.hpp"
#include "host/plugins/plugin_set_files.hpp"
#include "host/plugins/user_choice.hpp"
#include "plugins_widget.hpp"
#include "window/main_window.hpp"
#include "window/plugin_diff_dialog.hpp"
#include "window/settings_dialog.hpp"

#include <jet/ui/property_editor.hpp>

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenuBar>
#include <QPushButton>
#include <QSettings>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTest>
#include <QTextBrowser>
#include <QToolBar>
#include <QToolButton>
#include <QTreeView>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace jet::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class PluginsInTheWindowTest : public testing::Test {
protected:
    PluginsInTheWindowTest()
    {
        ::setenv("XDG_CONFIG_HOME", config_.path().c_str(), 1);
        QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, temporary_.path());
        folder.link("org.jet.test.good");
        folder.add("org.acme.needy", R"("requires": ["org.jet.test.good"])");
    }
    ~PluginsInTheWindowTest() override
    {
        window_.reset();
        QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        ::unsetenv("XDG_CONFIG_HOME");
    }

    host::MainWindow& start()
    {
        host::PluginOptions options;
        options.searchPath = {folder.path(), host::builtInPluginFolder()};
        options.disabled = host::readDisabledPlugins();
        options.set = host::PluginSet::of({"org.jet.test.good", "org.acme.needy", "org.jet.tool.rectangle",
                                           "org.jet.tool.ellipse", "org.jet.panel.plugins", "org.jet.panel.output"},
                                          "test");
        options.settings = host::userConfigFolder() / "settings";
        manager_ = std::make_unique<host::PluginManager>(std::move(options));
        manager_->scan();
        control_ = std::make_unique<host::PluginControl>(*manager_, events_);
        launch_ = std::make_unique<host::WindowLaunch>(
            host::WindowLaunch{*manager_, events_, {}, false, {}, control_.get(), useProjectPlugins});
        window_ = std::make_unique<host::MainWindow>(*launch_);
        window_->projects().setQuestion([] { return host::ProjectController::Answer::Discard; });
        window_->restoreSettings();
        window_->projects().create();
        window_->resize(1000, 700);
        window_->show();
        QApplication::processEvents();
        return *window_;
    }
    host::MainWindow& window() { return *window_; }
    host::PluginControl& control() { return *control_; }
    QStringList tools()
    {
        QStringList names;
        for (const QAction* action : window_->findChild<QToolBar*>("toolsBar")->actions())
            names << action->objectName();
        return names;
    }
    QPushButton* messageButton() { return window_->messages().findChild<QPushButton*>("messageAction"); }

    PluginFolder folder;
    host::UseProjectPlugins useProjectPlugins;

private:
    PluginFolder config_;
    QTemporaryDir temporary_;
    EventsCenter events_;
    std::unique_ptr<host::PluginManager> manager_;
    std::unique_ptr<host::PluginControl> control_;
    std::unique_ptr<host::WindowLaunch> launch_;
    std::unique_ptr<host::MainWindow> window_;
};

// --- switching

TEST_F(PluginsInTheWindowTest, ToolsMenusAndDocksFollowAPluginThatIsSwitched)
{
    start();
    EXPECT_TRUE(tools().contains("tool:rectangle"));
    ASSERT_NE(window().findChild<QAction*>("command:greet"), nullptr);
    ASSERT_TRUE(control().setEnabled("org.jet.tool.rectangle", false));
    ASSERT_TRUE(control().setEnabled("org.jet.test.good", false));
    ASSERT_TRUE(control().setEnabled("org.jet.panel.output", false));
    QApplication::processEvents();
    EXPECT_FALSE(tools().contains("tool:rectangle"));
    EXPECT_EQ(window().findChild<QAction*>("command:greet"), nullptr);
    EXPECT_TRUE(window().findChild<QDockWidget*>("panel:output")->isHidden());
    EXPECT_EQ(window().activeTool(), "ellipse") << "another tool takes the place of the active one";
    ASSERT_TRUE(control().setEnabled("org.jet.tool.rectangle", true));
    ASSERT_TRUE(control().setEnabled("org.jet.test.good", true));
    ASSERT_TRUE(control().setEnabled("org.jet.panel.output", true));
    QApplication::processEvents();
    EXPECT_TRUE(tools().contains("tool:rectangle"));
    EXPECT_NE(window().findChild<QAction*>("command:greet"), nullptr);
    EXPECT_FALSE(window().findChild<QDockWidget*>("panel:output")->isHidden());
}

TEST_F(PluginsInTheWindowTest, WhatIsMissingIsOfferedWithAButtonThatEnablesIt)
{
    start();
    ASSERT_TRUE(control().setEnabled("org.jet.test.good", false));
    window().showMissing(ContributionKind::Effect, "tint");
    EXPECT_THAT(window().messages().text().toStdString(), HasSubstr("The effect 'tint' needs Good"));
    ASSERT_NE(messageButton(), nullptr);
    QTest::mouseClick(messageButton(), Qt::LeftButton);
    EXPECT_TRUE(control().plugin("org.jet.test.good")->isUsable());
    window().showMissing(ContributionKind::Effect, "nowhere");
    QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    EXPECT_EQ(messageButton(), nullptr) << "nothing to enable";
}

// --- what a project wants

class ProjectPluginsTest : public PluginsInTheWindowTest {
protected:
    /// A shape with the effects "tint" (of Good, in the version given) and "hemp" (of a plugin that is nowhere).
    std::filesystem::path writeProject(const std::string& versionOfGood = "1.2.3", bool hemp = true)
    {
        const std::filesystem::path project = folder.path() / "game";
        std::filesystem::create_directories(project);
        std::ofstream(project / "project.jet")
            << "<jet-project version=\"1\" name=\"Game\"><plugins><plugin id=\"org.jet.test.good\" version=\"" +
                   versionOfGood + "\" uses=\"1\" provides=\"effects/tint\"/>" +
                   (hemp ? "<plugin id=\"org.acme.gone\" version=\"2.0.0\" uses=\"1\" provides=\"effects/hemp\"/>"
                         : "") +
                   "</plugins><filter name=\"F\"><scene name=\"One\" file=\"one.scene\"/></filter></jet-project>";
        std::ofstream(project / "one.scene")
            << std::string("<scene version=\"1\"><item type=\"shape\" id=\"1\" name=\"Box\"><path>M 0 0 L 10 0 L 10 10 "
                           "Z</path><effect type=\"tint\"><property id=\"color\">#ff0000</property></effect>") +
                   (hemp ? "<effect type=\"hemp\"/>" : "") + "</item></scene>";
        return project;
    }
    host::PluginDiffDialog* dialog() { return window().pluginController().differencesShown(); }
    QTableWidget* table() { return dialog()->findChild<QTableWidget*>("pluginDifferences"); }
    QString cell(int row, int column) { return table()->item(row, column)->text(); }
    Value color()
    {
        return *window().activeScene()->root().children().front()->effects().front().properties.find("color");
    }
    void pump()
    {
        for (int i = 0; i < 4; ++i) QApplication::processEvents();
    }
    using Dialog = host::PluginDiffDialog;
};

TEST_F(ProjectPluginsTest, OneDialogTellsAllDifferencesAndEnablesWhatCanBeEnabled)
{
    start();
    ASSERT_TRUE(control().setEnabled("org.jet.test.good", false));
    ASSERT_TRUE(window().projects().open(writeProject()));
    pump();
    ASSERT_NE(dialog(), nullptr);
    EXPECT_TRUE(dialog()->isVisible());
    EXPECT_TRUE(window().messages().text().isEmpty()) << "the dialog says it all";
    ASSERT_EQ(table()->rowCount(), 2);
    EXPECT_EQ(cell(0, Dialog::Name), "org.acme.gone");
    EXPECT_EQ(cell(0, Dialog::Wanted), "2.0.0");
    EXPECT_EQ(cell(0, Dialog::Here), "nothing");
    EXPECT_EQ(cell(0, Dialog::Uses), "1");
    EXPECT_THAT(cell(0, Dialog::Remedy).toStdString(), HasSubstr("Get its .jetplugin file"));
    EXPECT_EQ(cell(1, Dialog::Name), "Good");
    EXPECT_EQ(cell(1, Dialog::Here), "1.2.3, switched off");
    EXPECT_EQ(cell(1, Dialog::Remedy), "Enable it.");
    EXPECT_TRUE(color().isRaw());
    QTest::mouseClick(dialog()->findChild<QPushButton*>("enableAll"), Qt::LeftButton);
    pump();
    ASSERT_NE(dialog(), nullptr) << "one is missing still";
    ASSERT_EQ(table()->rowCount(), 1);
    EXPECT_FALSE(dialog()->findChild<QPushButton*>("enableAll")->isEnabled());
    EXPECT_FALSE(color().isRaw()) << "the project was read again behind it";
    dialog()->accept();
    pump();
    EXPECT_EQ(dialog(), nullptr) << "does not ask again";
    EXPECT_TRUE(control().plugin("org.jet.test.good")->isUsable());
}

TEST_F(ProjectPluginsTest, TheDialogEndsByItselfWhenNothingIsLeft)
{
    start();
    ASSERT_TRUE(control().setEnabled("org.jet.test.good", false));
    ASSERT_TRUE(window().projects().open(writeProject("1.2.3", false)));
    pump();
    ASSERT_NE(dialog(), nullptr);
    QTest::mouseClick(table()->findChild<QPushButton*>("org.jet.test.good"), Qt::LeftButton);
    pump();
    EXPECT_EQ(dialog(), nullptr);
    EXPECT_FALSE(color().isRaw());
}

TEST_F(ProjectPluginsTest, AnotherVersionIsToldUntilTheUserDoesNotWantToKnow)
{
    start();
    const auto project = writeProject("1.0.0", false);
    ASSERT_TRUE(window().projects().open(project));
    pump();
    ASSERT_NE(dialog(), nullptr);
    EXPECT_EQ(cell(0, Dialog::Wanted), "1.0.0");
    EXPECT_EQ(cell(0, Dialog::Here), "1.2.3");
    EXPECT_THAT(cell(0, Dialog::Remedy).toStdString(), HasSubstr("Go on with the newer one"));
    QCheckBox* again = dialog()->findChild<QCheckBox*>();
    ASSERT_TRUE(again->isVisible());
    again->setChecked(false);
    dialog()->accept();
    pump();
    window().projects().create();
    ASSERT_TRUE(window().projects().open(project));
    pump();
    EXPECT_EQ(dialog(), nullptr);
}

TEST_F(ProjectPluginsTest, NothingIsAskedWhereAllIsAsItWasSaved)
{
    start();
    ASSERT_TRUE(window().projects().open(writeProject("1.2.3", false)));
    pump();
    EXPECT_EQ(dialog(), nullptr);
    EXPECT_TRUE(window().messages().text().isEmpty());
}

TEST_F(ProjectPluginsTest, AnotherProjectTakesTheDialogAway)
{
    start();
    ASSERT_TRUE(window().projects().open(writeProject()));
    pump();
    ASSERT_NE(dialog(), nullptr);
    window().projects().create();
    ASSERT_TRUE(window().projects().open(writeProject("1.2.3", false)));
    pump();
    EXPECT_EQ(dialog(), nullptr);
}

TEST_F(ProjectPluginsTest, AFrozenEditorOpensNoProjectWithOtherPlugins)
{
    start();
    window().pluginController().setFrozen(true);
    EXPECT_FALSE(window().projects().open(writeProject("1.0.0", false)));
    EXPECT_THAT(window().messages().text().toStdString(), HasSubstr("org.jet.test.good: version 1.2.3 is here"));
    EXPECT_EQ(window().project().name(), "Untitled");
    EXPECT_TRUE(window().projects().open(writeProject("1.2.3", false)));
}

TEST_F(PluginsInTheWindowTest, AProjectsOwnPluginsComeInBeforeItIsRead)
{
    std::vector<std::string> asked;
    useProjectPlugins = [&](const std::filesystem::path& project, const std::function<bool(const std::string&)>& ask) {
        asked.push_back(project.filename().string());
        return ask("may they?") ? "" : "they were left out";
    };
    start();
    window().pluginController().setQuestion([](const std::string&) { return false; });
    EXPECT_FALSE(window().projects().open(folder.path() / "nowhere"));
    EXPECT_THAT(asked, ElementsAre("nowhere"));
    QStringList texts;
    for (const QLabel* label : window().messages().findChildren<QLabel*>()) texts << label->text();
    EXPECT_TRUE(texts.contains("they were left out")) << texts.join('\n').toStdString();
}

// --- settings

TEST_F(PluginsInTheWindowTest, TheSettingsDialogIsMadeFromTheTableAndStoresWhatIsTyped)
{
    start();
    host::SettingsDialog dialog(window(), &window());
    dialog.show();
    auto* list = dialog.findChild<QListWidget*>("settingsPages");
    ASSERT_EQ(list->count(), 1);
    EXPECT_EQ(list->item(0)->text(), "Good");
    auto* line = dialog.findChild<QLineEdit*>();
    ASSERT_NE(line, nullptr);
    EXPECT_EQ(line->text(), "good day");
    line->setFocus();
    line->selectAll();
    QTest::keyClicks(line, "hello");
    QTest::keyClick(line, Qt::Key_Return);
    const auto settings = control().settings("good");
    EXPECT_EQ(settings->get<std::string>("greeting"), "hello");
    window().findChild<QAction*>("command:greet")->trigger();
    EXPECT_EQ(window().messages().text(), "hello") << "the plugin reads it";
    for (QPushButton* button : dialog.findChildren<QPushButton*>())
        if (button->text().contains("Defaults")) QTest::mouseClick(button, Qt::LeftButton);
    EXPECT_EQ(settings->get<std::string>("greeting"), "good day");
}

// --- the panel

class PluginsPanelTest : public PluginsInTheWindowTest {
protected:
    PluginsPanelTest()
    {
        start();
        panel = std::make_unique<plugins::PluginsWidget>(window());
        panel->setQuestion([this](const QString& question) {
            questions << question;
            return answer;
        });
        panel->resize(900, 300);
        panel->show();
        QApplication::processEvents();
        table = panel->findChild<QTreeView*>("pluginTable");
    }
    QModelIndex row(const QString& name) const
    {
        for (int i = 0; i < table->model()->rowCount(); ++i)
            if (table->model()->index(i, 0).data().toString() == name) return table->model()->index(i, 0);
        return {};
    }
    /// Clicks the check box of a row as a user would.
    void tick(const QString& name)
    {
        table->scrollTo(row(name));
        const QRect box = table->visualRect(row(name));
        QTest::mouseClick(table->viewport(), Qt::LeftButton, {}, QPoint(box.left() + 10, box.center().y()));
        QApplication::processEvents();
    }
    std::string details() const
    {
        return panel->findChild<QTextBrowser*>("pluginDetails")->toPlainText().toStdString();
    }

    std::unique_ptr<plugins::PluginsWidget> panel;
    QTreeView* table = nullptr;
    QStringList questions;
    bool answer = true;
};

TEST_F(PluginsPanelTest, TheFilterLooksAtNamesStatesAndContributions)
{
    const int all = table->model()->rowCount();
    EXPECT_GE(all, 5);
    auto* filter = panel->findChild<QLineEdit*>("pluginFilter");
    QTest::keyClicks(filter, "tool.rectangle");
    EXPECT_EQ(table->model()->rowCount(), 1);
    filter->clear();
    QTest::keyClicks(filter, "boxes");
    EXPECT_TRUE(row("Good").isValid()) << "the plugin that contributes that format";
    EXPECT_LT(table->model()->rowCount(), all);
    filter->clear();
    QTest::keyClicks(filter, "switched off");
    EXPECT_LT(table->model()->rowCount(), all);
    filter->clear();
    EXPECT_EQ(table->model()->rowCount(), all);
}

TEST_F(PluginsPanelTest, TickingOffNamesTheDependentsAndAsksFirst)
{
    answer = false;
    tick("Good");
    ASSERT_EQ(questions.size(), 1);
    EXPECT_THAT(questions[0].toStdString(),
                HasSubstr("These plugins require Good and are switched off with it: org.acme.needy"));
    EXPECT_TRUE(control().plugin("org.jet.test.good")->isUsable());
    EXPECT_EQ(row("Good").data(Qt::CheckStateRole).toInt(), Qt::Checked);
    answer = true;
    tick("Good");
    EXPECT_FALSE(control().plugin("org.jet.test.good")->isUsable());
    EXPECT_EQ(row("Good").data(Qt::CheckStateRole).toInt(), Qt::Unchecked);
    EXPECT_EQ(row("org.acme.needy").data(Qt::CheckStateRole).toInt(), Qt::Unchecked);
    tick("org.acme.needy");
    EXPECT_THAT(questions.last().toStdString(), HasSubstr("requires plugins that are switched off: org.jet.test.good"));
    EXPECT_TRUE(control().plugin("org.jet.test.good")->isUsable()) << "what it requires is switched on with it";
}

TEST_F(PluginsPanelTest, DetailsTellReasonContributionsAndCost)
{
    ASSERT_NE(window().catalog().effect("tint"), nullptr);
    panel->refresh();
    table->setCurrentIndex(row("Good"));
    EXPECT_THAT(details(), HasSubstr("org.jet.test.good"));
    EXPECT_THAT(details(), HasSubstr("importer “Boxes” .boxes"));
    EXPECT_THAT(details(), HasSubstr("Loaded in"));
    EXPECT_THAT(details(), HasSubstr("kB"));
    EXPECT_FALSE(panel->findChild<QToolButton*>("pluginRemove")->isEnabled()) << "not one of the user's own";
    ASSERT_TRUE(control().setEnabled("org.jet.test.good", false));
    EXPECT_THAT(details(), HasSubstr("switched off; 'jet plugins enable org.jet.test.good'"));
}

TEST_F(PluginsPanelTest, WhatCannotBeInstalledIsSaid)
{
    panel->install("nothing.jetplugin");
    EXPECT_THAT(window().messages().text().toStdString(), HasSubstr("cannot install plugins"));
}

// --- sets

TEST_F(PluginsPanelTest, ASetIsChosenAndToolsFollowAtOnce)
{
    auto* chooser = panel->findChild<QComboBox*>("pluginSet");
    ASSERT_NE(chooser, nullptr);
    EXPECT_THAT(chooser->currentText().toStdString(), testing::StartsWith("test ("));
    EXPECT_FALSE(tools().contains("tool:selection"));
    const int minimal = chooser->findText("Minimal", Qt::MatchStartsWith);
    ASSERT_GE(minimal, 0);
    chooser->setCurrentIndex(minimal);
    emit chooser->activated(minimal);
    QApplication::processEvents();
    EXPECT_TRUE(tools().contains("tool:selection"));
    EXPECT_FALSE(tools().contains("tool:rectangle"));
    EXPECT_EQ(host::readChosenSet(), "minimal") << "for later runs";
    EXPECT_EQ(chooser->currentIndex(), minimal);
    EXPECT_FALSE(control().plugin("org.jet.test.good")->isUsable());
    EXPECT_THAT(control().plugin("org.jet.test.good")->reason, HasSubstr("not in the chosen plugin set 'minimal'"));
    emit chooser->activated(0);  // all plugins
    QApplication::processEvents();
    EXPECT_TRUE(tools().contains("tool:rectangle"));
    EXPECT_EQ(host::readChosenSet(), "");
}

TEST_F(PluginsPanelTest, WhatIsInUseIsSavedAsASet)
{
    auto* chooser = static_cast<plugins::SetChooser*>(panel->findChild<QComboBox*>("pluginSet"));
    chooser->askName = [](const QString&) { return QStringLiteral("My tools"); };
    emit chooser->activated(chooser->count() - 1);
    EXPECT_GE(chooser->findText("My tools", Qt::MatchStartsWith), 0);
    const auto set = host::PluginSetFiles().read("My tools");
    ASSERT_TRUE(set) << set.error().text();
    EXPECT_TRUE(set->holds("org.jet.tool.rectangle"));
    EXPECT_FALSE(set->holds("org.jet.tool.selection")) << "is left out at present";
    chooser->askName = [](const QString&) { return QStringLiteral("../bad"); };
    emit chooser->activated(chooser->count() - 1);
    EXPECT_THAT(window().messages().text().toStdString(), HasSubstr("cannot be the name of a plugin set"));
}

TEST_F(PluginsPanelTest, SwitchingOffThePanelItselfIsSurvived)
{
    auto* dock = window().findChild<QDockWidget*>("panel:plugin-manager");
    ASSERT_NE(dock, nullptr);
    dock->show();
    dock->raise();
    QApplication::processEvents();
    ASSERT_NE(dock->widget(), nullptr);
    tick("Plugins panel");
    EXPECT_TRUE(dock->isHidden());
    EXPECT_EQ(dock->widget(), nullptr);
}

}  // namespace
}  // namespace jet::test
