// A folder for tests of whole projects: files in, files out.
#pragma once

#include "fixtures/fakes.hpp"
#include "support/test_catalog.hpp"

#include <jet/project.hpp>

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <sstream>
#include <unistd.h>

namespace jet::host {

class ProjectFilesTest : public testing::Test {
protected:
    ProjectFilesTest()
    {
        catalog.inCode().effect<test::TintEffect>("tint");
        catalog.inCode().itemType<test::RopeType>("rope");
        std::string name = (std::filesystem::temp_directory_path() / "jet-projects-XXXXXX").string();
        folder = ::mkdtemp(name.data());
    }
    ~ProjectFilesTest() override { std::filesystem::remove_all(folder); }

    void write(const std::string& name, const std::string& content) const
    {
        std::filesystem::create_directories((folder / name).parent_path());
        std::ofstream(folder / name, std::ios::binary) << content;
    }
    std::string read(const std::filesystem::path& file) const
    {
        std::ifstream in(folder / file, std::ios::binary);
        std::stringstream all;
        all << in.rdbuf();
        return all.str();
    }
    /// All files below a folder, by name.
    std::map<std::string, std::string> files(const std::filesystem::path& below) const
    {
        std::map<std::string, std::string> all;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / below))
            if (entry.is_regular_file())
                all[entry.path().lexically_relative(folder / below).string()] = read(entry.path());
        return all;
    }
    /// "game": a scene with these items.
    void writeGame(const std::string& items)
    {
        write("game/project.jet", "<jet-project version=\"1\" name=\"Game\">\n<filter name=\"F\">\n"
                                  "<scene name=\"One\" file=\"scenes/One.scene\"/>\n</filter>\n</jet-project>\n");
        write("game/scenes/One.scene", "<scene version=\"1\">\n" + items + "</scene>\n");
    }
    std::unique_ptr<Project> load(const std::string& name = "game")
    {
        return Project::load(folder / name, events, catalog).orThrow();
    }

    test::TestCatalog catalog;
    EventsCenter events;
    std::filesystem::path folder;
};

}  // namespace jet::host
