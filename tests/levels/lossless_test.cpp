// Nothing is lost for the lack of a plugin: the examples, opened and written with each plugin missing in turn and with
// random sets of them missing, keep their bytes; a change of one item changes its line only.
#include "host/plugins/plugin_manager.hpp"

#include <jet/effect.hpp>
#include <jet/item_type.hpp>
#include <jet/project.hpp>

#include <gtest/gtest.h>
#include <test_paths.hpp>

#include <filesystem>
#include <random>
#include <set>
#include <sstream>

namespace {

namespace fs = std::filesystem;
using namespace jet;

const fs::path kExamples = fs::path(JET_SOURCE_DIR) / "examples";

std::vector<fs::path> examples()
{
    std::vector<fs::path> folders;
    for (const auto& entry : fs::recursive_directory_iterator(kExamples))
        if (entry.path().filename() == "project.jet") folders.push_back(entry.path().parent_path());
    std::sort(folders.begin(), folders.end());
    return folders;
}

std::vector<std::string> lines(const std::string& text)
{
    std::vector<std::string> all;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
}

class Lossless : public testing::Test {
protected:
    Lossless()
    {
        std::string name = (fs::temp_directory_path() / "jet-lossless-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
    }
    ~Lossless() override { fs::remove_all(folder_); }

    static std::unique_ptr<host::PluginManager> pluginsWithout(const std::set<std::string>& missing)
    {
        host::PluginOptions options;
        options.builtIn = host::builtInPluginFolder();
        options.searchPath = {options.builtIn};
        options.without = missing;
        auto plugins = std::make_unique<host::PluginManager>(std::move(options));
        plugins->scan();
        return plugins;
    }

    /// Ids of the plugins an example uses.
    std::vector<std::string> used(const fs::path& example)
    {
        auto plugins = pluginsWithout({});
        std::vector<std::string> ids;
        for (const PluginUse& use : Project::load(example, events_, *plugins).orThrow()->pluginsUsed())
            ids.push_back(use.id);
        return ids;
    }

    /// Opens a copy without these plugins, writes it, compares; then moves one item and compares again.
    void check(const fs::path& example, const std::set<std::string>& missing)
    {
        std::string what = example.filename().string() + " without";
        for (const std::string& id : missing) what += " " + id;
        SCOPED_TRACE(what);
        fs::remove_all(folder_ / "copy");
        fs::copy(example, folder_ / "copy", fs::copy_options::recursive);
        auto plugins = pluginsWithout(missing);
        auto project = Project::load(folder_ / "copy", events_, *plugins).orThrow();
        project->saveAs(folder_ / "copy").orThrow();  // writes every file
        compare(example, {});
        for (Scene* scene : project->scenes()) moveOne(*scene);
        project->save().orThrow();
        compare(example, moved_);
        for (Scene* scene : project->scenes()) scene->undoRedo().undo();
        project->save().orThrow();
        compare(example, {});
    }

    /// The same files, but for `changed` lines in each scene.
    void compare(const fs::path& example, const std::map<std::string, std::size_t>& changed)
    {
        for (const auto& entry : fs::recursive_directory_iterator(example)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".scene" && extension != ".jet") continue;
            const fs::path copy = folder_ / "copy" / fs::relative(entry.path(), example);
            const auto before = lines(readFile(entry.path()).orThrow()), after = lines(readFile(copy).orThrow());
            ASSERT_EQ(before.size(), after.size()) << copy;
            std::size_t differ = 0;
            for (std::size_t i = 0; i < before.size(); ++i) differ += before[i] != after[i];
            const auto expected = changed.find(entry.path().stem().string());
            EXPECT_EQ(differ, expected == changed.end() ? 0 : expected->second) << copy;
        }
    }

    void moveOne(Scene& scene)
    {
        const Item* chosen = nullptr;
        scene.root().walk([&](const Item& item) {
            if (!chosen && !item.path().isEmpty()) chosen = &item;
        });
        if (!chosen) return;
        auto edit = scene.items().begin("Move");
        edit.transform(*chosen, Affine::translation({12.25, -3}));
        edit.commit();
        moved_[scene.name()] = 1;
    }

    EventsCenter events_;
    fs::path folder_;
    std::map<std::string, std::size_t> moved_;  // by name of the scene
};

TEST_F(Lossless, EveryExampleKeepsItsBytesWithEachPluginMissing)
{
    ASSERT_FALSE(examples().empty());
    for (const fs::path& example : examples()) {
        check(example, {});
        for (const std::string& id : used(example)) check(example, {id});
    }
}

TEST_F(Lossless, EveryExampleKeepsItsBytesWithRandomSetsMissing)
{
    std::mt19937 random(7);
    for (const fs::path& example : examples()) {
        const auto ids = used(example);
        check(example, {ids.begin(), ids.end()});
        for (int i = 0; i < 6; ++i) {
            std::set<std::string> missing;
            for (const std::string& id : ids)
                if (random() % 2 == 0) missing.insert(id);
            check(example, missing);
        }
    }
}

TEST_F(Lossless, ItemsOfMissingPluginsCanBeMovedCopiedDeletedAndUndone)
{
    for (const fs::path& example : examples()) {
        const auto ids = used(example);
        auto plugins = pluginsWithout({ids.begin(), ids.end()});
        auto project = Project::load(example, events_, *plugins).orThrow();
        for (Scene* scene : project->scenes()) {
            std::vector<ItemId> withEffects;
            scene->root().walk([&](const Item& item) {
                if (!item.effects().empty()) withEffects.push_back(item.id());
            });
            const std::string before = writeSceneText(*scene);
            for (const ItemId id : withEffects) {
                auto edit = scene->items().begin("Move, copy, delete");
                const Item& item = *scene->items().find(id);
                edit.transform(item, Affine::scaling({2, 2}));
                edit.addCopy(item, scene->root());
                edit.removeEffect(item, 0);
                edit.remove(item);
                edit.commit();
            }
            while (scene->undoRedo().canUndo()) scene->undoRedo().undo();
            EXPECT_EQ(writeSceneText(*scene), before) << example;
        }
    }
}

}  // namespace
