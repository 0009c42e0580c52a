// Plugins in the running window: rebuilt ones are swapped in, failing ones are taken out, and the editor goes on.
#include "host/app/managed_plugins.hpp"
#include "window/crash_dialog.hpp"
#include "window/guarded_application.hpp"
#include "window/main_window.hpp"

#include "../host/plugins/plugin_folder.hpp"

#include <QCheckBox>
#include <QPushButton>
#include <QSettings>
#include <QTemporaryDir>
#include <QTest>

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

    /// The window with the plugins of the folder and the shipped tools, watching the folder.
    void start()
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
        launch_->watch = {folder.path()};
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
