// Plugins in the running window: rebuilt ones are swapped in, failing ones are taken out, and the editor goes on.
#include "host/app/managed_plugins.hpp"
#include "host/plugins/plugin_control.hpp"
#include "window/crash_dialog.hpp"
#include "window/guarded_application.hpp"
#include "window/main_window.hpp"

#include "../host/plugins/plugin_folder.hpp"

#include <QCheckBox>
#include <QPointer>
#include <QPushButton>
#include <QRadioButton>
#include <QSettings>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>
#include <QTreeView>
#include <QTreeWidget>

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

namespace jet::host {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

PluginRuntime* control = nullptr;  // of the test that runs; the application outlives them all

/// Passes everything on to the test's own.
class Relay final : public PluginRuntime {
public:
    void guardEvent(std::string_view plugin, const std::function<void()>& deliver) override
    {
        control ? control->guardEvent(plugin, deliver) : deliver();
    }
    void showLife() override
    {
        if (control) control->showLife();
    }
    bool isUsable(std::string_view plugin) const override { return control && control->isUsable(plugin); }
    bool isInCall(std::string_view plugin) const override { return control && control->isInCall(plugin); }
    std::string ownerOf(const void* address) const override { return control ? control->ownerOf(address) : ""; }
    void blame(std::string_view plugin, std::exception_ptr problem) override { control->blame(plugin, problem); }
    std::filesystem::path folderOf(std::string_view plugin) const override { return control->folderOf(plugin); }
    std::vector<std::string> loaded() const override { return control->loaded(); }
    std::string titleOf(std::string_view plugin) const override { return control->titleOf(plugin); }
    Result<void> reload(std::string_view plugin, const std::function<void()>& before) override
    {
        return control->reload(plugin, before);
    }
    Result<std::string> add(const std::filesystem::path& folder) override { return control->add(folder); }
};

class PluginsInTheWindow : public testing::Test {
protected:
    PluginsInTheWindow() { QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, settings_.path()); }
    ~PluginsInTheWindow() override
    {
        if (window_) window_->close();
        window_.reset();
        QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        control = nullptr;
    }

    /// The window with the plugins of the folder and the shipped tools, watching the folder unless told otherwise.
    void start(bool watching = true)
    {
        PluginOptions options;
        options.searchPath = {folder.path(), builtInPluginFolder()};
        options.copyLibraries = true;
        manager_ = std::make_unique<PluginManager>(options);
        manager_->setProblemHandler([this](const PluginProblem& problem) { problems.push_back(problem.message); });
        manager_->scan();
        plugins_ = std::make_unique<ManagedPlugins>(*manager_);
        control = plugins_.get();
        launch_ = std::make_unique<WindowLaunch>(WindowLaunch{*manager_, events_, {}, false, {}});
        launch_->runtime = control;
        launch_->pluginProblems = [this] { return manager_->problems(); };
        if (watching) launch_->watch = {folder.path()};
        center_ = std::make_unique<PluginControl>(*manager_, events_);
        launch_->plugins = center_.get();
        launch_->setReloader = [this](auto reload) { center_->setReloader(std::move(reload)); };
        window_ = std::make_unique<MainWindow>(*launch_);
        window_->projects().setQuestion([] { return ProjectController::Answer::Discard; });
        window_->projects().setRecoveryQuestion([](const auto&) { return RecoveryChoice{}; });
        window_->restoreSettings();
        window_->projects().create();
        window_->resize(1000, 700);
        window_->show();
        QApplication::processEvents();
    }
    void copyFixture(const std::string& id)
    {
        std::filesystem::copy(test::fixtureFolder() / id, folder.path() / id,
                              std::filesystem::copy_options::recursive |
                                  std::filesystem::copy_options::overwrite_existing);
    }
    /// The manifest with another version and a library of another time: a rebuild.
    void rebuild(const std::string& id, const std::string& version)
    {
        const auto file = folder.path() / id / "plugin.json";
        std::stringstream text;
        text << std::ifstream(test::fixtureFolder() / id / "plugin.json").rdbuf();
        std::string manifest = text.str();
        manifest.replace(manifest.find("1.0.0", manifest.find("\"version\"")), 5, version);
        for (const auto& entry : std::filesystem::directory_iterator(test::fixtureFolder() / id)) {
            if (entry.path().extension() != ".so") continue;
            const auto target = folder.path() / id / entry.path().filename();
            std::filesystem::remove(target);
            std::filesystem::copy_file(entry.path(), target);
        }
        std::ofstream(file) << manifest;
    }
    std::string versionOf(const std::string& id) const
    {
        const Plugin* plugin = manager_->plugin(id);
        return plugin ? plugin->manifest.version.text() : "none";
    }
    bool becomes(const std::function<bool()>& condition) const { return QTest::qWaitFor(condition, 5000); }
    MainWindow& window() { return *window_; }
    PluginControl& center() { return *center_; }
    EventsCenter& events() { return events_; }
    SceneView& view() { return *window_->documents().currentView(); }
    Scene& scene() { return *window_->activeScene(); }
    void drawBox()
    {
        auto edit = scene().items().begin("Draw");
        const Item& box = edit.add<ShapeItem>(scene().root(), Path::rectangle(Box({0, 0}, {50, 50})));
        edit.select(box);
        edit.commit();
    }

    test::PluginFolder folder;
    std::vector<std::string> problems;

private:
    QTemporaryDir settings_;
    EventsCenter events_;
    std::unique_ptr<PluginManager> manager_;
    std::unique_ptr<ManagedPlugins> plugins_;
    std::unique_ptr<PluginControl> center_;
    std::unique_ptr<WindowLaunch> launch_;
    std::unique_ptr<MainWindow> window_;
};

constexpr const char* kBench = "org.jet.test.bench";

TEST_F(PluginsInTheWindow, ARebuiltPluginIsSwappedAndEverythingElseStays)
{
    copyFixture(kBench);
    start();
    window().setActiveTool("bench");
    drawBox();
    const auto hash = scene().hash();
    const auto selection = scene().items().selection();
    const Tool* before = view().tool()->tool();
    rebuild(kBench, "1.1.0");
    ASSERT_TRUE(becomes([&] { return versionOf(kBench) == "1.1.0"; })) << window().messages().text().toStdString();
    EXPECT_EQ(window().activeTool(), "bench");
    ASSERT_NE(view().tool(), nullptr);
    ASSERT_NE(view().tool()->tool(), nullptr);
    EXPECT_NE(view().tool()->tool(), before) << "another tool object";
    EXPECT_EQ(scene().hash(), hash);
    EXPECT_EQ(scene().items().selection(), selection);
    EXPECT_EQ(scene().undoRedo().undoLabel(), "Draw");
    scene().undoRedo().undo();
    scene().undoRedo().redo();
    EXPECT_EQ(scene().hash(), hash);
    QTest::mouseMove(&view(), QPoint(100, 100));
    EXPECT_TRUE(problems.empty());
}

TEST_F(PluginsInTheWindow, ABrokenRebuildIsToldAndTheOldPluginGoesOn)
{
    copyFixture(kBench);
    start();
    window().setActiveTool("bench");
    std::ofstream(folder.path() / kBench / "plugin.json") << "{ broken";
    ASSERT_TRUE(becomes([&] { return !window().messages().text().isEmpty(); }));
    EXPECT_THAT(window().messages().text().toStdString(), HasSubstr("plugin.json"));
    EXPECT_NE(view().tool()->tool(), nullptr);
    rebuild(kBench, "1.2.0");
    EXPECT_TRUE(becomes([&] { return versionOf(kBench) == "1.2.0"; }));
}

TEST_F(PluginsInTheWindow, AHalfWrittenLibraryIsNotLoaded)
{
    const auto whole = test::fixtureFolder() / kBench / "fixture-bench.so";
    EXPECT_TRUE(PluginWatcher::isWhole(whole));
    const auto half = folder.path() / "half.so";
    std::filesystem::copy_file(whole, half);
    std::filesystem::resize_file(half, std::filesystem::file_size(half) / 2);
    EXPECT_FALSE(PluginWatcher::isWhole(half));
    EXPECT_FALSE(PluginWatcher::isWhole(folder.path() / "none.so"));
}

TEST_F(PluginsInTheWindow, APluginThatComesLaterIsTakenIn)
{
    start();
    copyFixture(kBench);
    rebuild(kBench, "2.0.0");
    ASSERT_TRUE(becomes([&] { return versionOf(kBench) == "2.0.0"; }));
    window().setActiveTool("bench");
    EXPECT_EQ(window().activeTool(), "bench");
}

// --- reloading by hand

TEST_F(PluginsInTheWindow, ReloadingByHandKeepsSceneUndoHistoryAndTheToolAndTellsOfTheChange)
{
    copyFixture(kBench);
    start(false);
    window().setActiveTool("bench");
    drawBox();
    const auto hash = scene().hash();
    const Tool* before = view().tool()->tool();
    std::vector<std::string> told;
    const auto listener = events().subscribe<PluginsChanged>(nullptr, [&](const PluginsChanged& change) {
        told.insert(told.end(), change.plugins.begin(), change.plugins.end());
    });
    rebuild(kBench, "1.1.0");
    const auto change = center().reload(kBench);
    ASSERT_TRUE(change) << change.error().text();
    EXPECT_THAT(change->message, HasSubstr("org.jet.test.bench 1.1.0) was reloaded."));
    EXPECT_EQ(versionOf(kBench), "1.1.0");
    QApplication::processEvents();
    EXPECT_THAT(told, ElementsAre(kBench));
    EXPECT_EQ(window().activeTool(), "bench");
    EXPECT_NE(view().tool()->tool(), before) << "another tool object";
    EXPECT_EQ(scene().hash(), hash);
    EXPECT_EQ(scene().undoRedo().undoLabel(), "Draw");
    scene().undoRedo().undo();
    scene().undoRedo().redo();
    EXPECT_EQ(scene().hash(), hash);
    EXPECT_TRUE(problems.empty());
}

TEST_F(PluginsInTheWindow, ReloadingByHandKeepsTheOptionsOfTools)
{
    start(false);
    window().setActiveTool("rectangle");
    window().setToolOption("color", Color{1, 2, 3, 255});
    ASSERT_TRUE(center().reload("org.jet.tool.rectangle"));
    QApplication::processEvents();
    EXPECT_EQ(window().activeTool(), "rectangle");
    EXPECT_EQ(view().tool()->options().find("color")->as<Color>(), (Color{1, 2, 3, 255}));
}

TEST_F(PluginsInTheWindow, ReloadingByHandIsRefusedWithTheReasonAndTheOldPluginGoesOn)
{
    copyFixture(kBench);
    start(false);
    window().setActiveTool("bench");
    std::ofstream(folder.path() / kBench / "plugin.json") << "{ broken";
    const auto change = center().reload(kBench);
    ASSERT_FALSE(change);
    EXPECT_THAT(change.error().text(), HasSubstr("was not reloaded, what was loaded before goes on"));
    EXPECT_THAT(change.error().text(), HasSubstr("plugin.json:1:3: error"));
    EXPECT_NE(view().tool()->tool(), nullptr);
    EXPECT_THAT(center().reload("org.acme.nothing").error().message,
                HasSubstr("there is no plugin 'org.acme.nothing'"));
}

TEST_F(PluginsInTheWindow, WhileAGamePlaysReloadingByHandWaitsForItsEnd)
{
    copyFixture(kBench);
    start(false);
    window().setActiveTool("bench");
    drawBox();
    window().actionTable().find("play.play")->trigger();
    ASSERT_NE(window().simulation().state(), SimulationCenter::State::Stopped);
    rebuild(kBench, "1.1.0");
    const auto change = center().reload(kBench);
    ASSERT_TRUE(change);
    EXPECT_THAT(change->message, HasSubstr("is reloaded when the play stops."));
    EXPECT_EQ(versionOf(kBench), "1.0.0");
    window().simulation().stop();
    EXPECT_TRUE(becomes([&] { return versionOf(kBench) == "1.1.0"; }));
}

TEST_F(PluginsInTheWindow, ThePluginsPanelReloadsItself)
{
    start(false);
    auto* dock = window().findChild<QDockWidget*>("panel:plugin-manager");
    ASSERT_NE(dock, nullptr);
    dock->show();
    dock->raise();
    ASSERT_TRUE(becomes([&] { return dock->findChild<QTreeView*>("pluginTable") != nullptr; }));
    auto* table = dock->findChild<QTreeView*>("pluginTable");
    const QPointer<QTreeView> before = table;
    for (int row = 0; row < table->model()->rowCount(); ++row)
        if (table->model()->index(row, 0).data().toString() == "Plugins panel")
            table->setCurrentIndex(table->model()->index(row, 0));
    auto* button = dock->findChild<QToolButton*>("pluginReload");
    ASSERT_TRUE(button->isEnabled());
    QTest::mouseClick(button, Qt::LeftButton);  // in the middle of a call into the plugin that is to go
    EXPECT_TRUE(becomes([&] { return before.isNull() && dock->findChild<QTreeView*>("pluginTable") != nullptr; }));
    EXPECT_TRUE(problems.empty());
}

// --- panels

struct PanelCase {
    const char* button;
    const char* message;
};
class EvilPanelTest : public PluginsInTheWindow, public testing::WithParamInterface<PanelCase> {};

TEST_P(EvilPanelTest, IsNamedAndReplacedByTheReason)
{
    copyFixture("org.jet.test.evil-panel");
    start();
    auto* dock = window().findChild<QDockWidget*>("panel:evil-panel");
    ASSERT_NE(dock, nullptr);
    dock->show();
    dock->raise();
    ASSERT_TRUE(becomes([&] { return dock->findChild<QPushButton*>(GetParam().button) != nullptr; }));
    // Through the application, as real events come.
    QTest::mouseClick(dock->findChild<QPushButton*>(GetParam().button), Qt::LeftButton);
    ASSERT_TRUE(becomes([&] { return !problems.empty(); }));
    EXPECT_THAT(problems[0], HasSubstr(GetParam().message));
    EXPECT_TRUE(becomes([&] { return dock->findChild<QPushButton*>() == nullptr; })) << "its widgets are gone";
    EXPECT_TRUE(becomes([&] { return window().messages().text().contains("evil-panel"); }));
    const std::size_t before = scene().items().itemCount();
    drawBox();
    EXPECT_EQ(scene().items().itemCount(), before + 1) << "the editor works on";
}

INSTANTIATE_TEST_SUITE_P(
    Plugins, EvilPanelTest,
    testing::Values(
        PanelCase{"slot", "Evil: panel (org.jet.test.evil-panel 1.0.0) was switched off: an event of its panel failed: "
                          "the slot broke"},
        PanelCase{"timer", "an event of its panel failed: the timer broke"},
        PanelCase{"stray",
                  "(org.jet.test.evil-panel 1.0.0) was switched off: its own code failed: the stray timer broke"},
        PanelCase{"paint", "an event of its panel failed: cannot paint"}),
    [](const auto& info) { return std::string(info.param.button); });

// --- after a crash

TEST(CrashDialogTest, LeavesOutEachPluginOnceUnlessToldOtherwise)
{
    const CrashDialog dialog({{"org.acme.a", "it crashed"}, {"org.acme.b", "it crashed"}, {"org.acme.a", "again"}});
    EXPECT_THAT(dialog.leftOut(), ElementsAre("org.acme.a", "org.acme.b"));
    dialog.findChildren<QCheckBox*>().first()->setChecked(false);
    EXPECT_THAT(dialog.leftOut(), ElementsAre("org.acme.b"));
    EXPECT_FALSE(dialog.safeMode());
    EXPECT_EQ(dialog.recovery().kind, RecoveryChoice::Kind::Later) << "there is no work to recover";
}

TEST(CrashDialogTest, GoesOnWithAllPluginsOrWithTheShippedOnesWhereThatIsChosen)
{
    const CrashDialog dialog(std::vector<CrashNote>{{"org.acme.a", "it crashed"}});
    auto* without = dialog.findChild<QRadioButton*>("withoutPlugins");
    ASSERT_TRUE(without->isChecked());
    dialog.findChild<QRadioButton*>("safeMode")->setChecked(true);
    EXPECT_TRUE(dialog.safeMode());
    EXPECT_TRUE(dialog.leftOut().empty());
    EXPECT_FALSE(dialog.findChild<QCheckBox*>()->isEnabled());
    dialog.findChild<QRadioButton*>("withAllPlugins")->setChecked(true);
    EXPECT_FALSE(dialog.safeMode());
    EXPECT_TRUE(dialog.leftOut().empty());
}

TEST(CrashDialogTest, OffersTheUnsavedWorkInTheSameDialog)
{
    JournalInfo first, second;
    first.name = "Game", first.changes = 3, first.project = "/games/game/project.jet";
    second.name = "Untitled", second.changes = 1;
    const CrashDialog dialog(std::vector<CrashNote>{{"org.acme.a", "it crashed"}}, {first, second});
    auto* work = dialog.findChild<QTreeWidget*>("unsavedWork");
    ASSERT_EQ(work->topLevelItemCount(), 2);
    EXPECT_EQ(work->topLevelItem(0)->text(1), "3");
    EXPECT_EQ(dialog.recovery().kind, RecoveryChoice::Kind::Recover) << "nothing is lost by pressing Enter";
    work->setCurrentItem(work->topLevelItem(1));
    EXPECT_EQ(dialog.recovery().index, 1u);
    dialog.findChild<QRadioButton*>("keepWork")->setChecked(true);
    EXPECT_EQ(dialog.recovery().kind, RecoveryChoice::Kind::Later);
    EXPECT_FALSE(dialog.leftOut().empty()) << "the plugins are another question";
    dialog.findChild<QRadioButton*>("discardWork")->setChecked(true);
    EXPECT_EQ(dialog.recovery().kind, RecoveryChoice::Kind::Discard);
}

}  // namespace
}  // namespace jet::host

int main(int argc, char** argv)
{
    testing::InitGoogleMock(&argc, argv);
    if (!qEnvironmentVariableIsSet("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
    const QTemporaryDir state;
    qputenv("XDG_STATE_HOME", state.path().toUtf8());  // the journals of these tests are nobody else's
    jet::host::Relay relay;
    jet::host::GuardedApplication application(argc, argv, &relay);
    return RUN_ALL_TESTS();
}
