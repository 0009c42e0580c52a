// Runs the built bin/jet as a person or a script would: arguments in, exit code, stdout and stderr out. Each test has a
// folder of its own that is also the configuration and data folder; the only plugins are the fixtures it asks for.
#pragma once

#include "../plugins/plugin_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <test_paths.hpp>

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <sys/wait.h>

namespace jet::test {

using testing::HasSubstr;

struct Outcome {
    int code = -1;
    std::string out, err;
};

class CliTest : public testing::Test {
protected:
    CliTest()
    {
        std::filesystem::create_directories(home());
        write(
            "test.jetset",
            R"({ "name": "Test", "plugins": [], "optional": ["org.jet.test.good", "org.jet.test.throws-inside", "org.jet.test.throws-on-load",
                                                       "org.jet.test.no-symbol", "org.acme.a", "org.acme.b"] })");
    }

    std::filesystem::path home() const { return folder_.path() / "home"; }
    std::string file(const std::string& name) const { return (home() / name).string(); }
    void write(const std::string& name, const std::string& content)
    {
        std::filesystem::create_directories((home() / name).parent_path());
        std::ofstream(home() / name) << content;
    }
    std::string read(const std::string& name) const
    {
        std::ifstream in(home() / name);
        std::stringstream all;
        all << in.rdbuf();
        return all.str();
    }
    bool exists(const std::string& name) const { return std::filesystem::exists(home() / name); }
    std::map<std::string, std::string> files() const
    {
        std::map<std::string, std::string> all;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(home()))
            if (entry.is_regular_file()) {
                const std::string name = std::filesystem::relative(entry.path(), home()).string();
                all[name] = read(name);
            }
        return all;
    }
    PluginFolder& plugins() { return plugins_; }

    /// Runs `jet ARGUMENTS` in the home folder, through the shell, with the test's plugins.
    Outcome jet(const std::string& arguments)
    {
        return plain("--plugins '" + file("test.jetset") + "' --plugin-path '" + plugins_.path().string() + "' " +
                     arguments);
    }
    Outcome plain(const std::string& arguments, const std::string& environment = "")
    {
        const std::string out = (folder_.path() / "out").string(), err = (folder_.path() / "err").string();
        const std::string command = "cd '" + home().string() +
                                    "' && env -u DISPLAY -u WAYLAND_DISPLAY -u QT_QPA_PLATFORM XDG_CONFIG_HOME='" +
                                    home().string() + "/config' XDG_DATA_HOME='" + home().string() +
                                    "/data' XDG_STATE_HOME='" + home().string() + "/state' " + environment +
                                    " '" JET_BINARY_DIR "/bin/jet' " + arguments + " > '" + out + "' 2> '" + err + "'";
        const int status = std::system(command.c_str());
        const auto content = [](const std::string& name) {
            std::ifstream in(name);
            std::stringstream all;
            all << in.rdbuf();
            return all.str();
        };
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), content(out), content(err)};
    }

    static std::size_t lines(const std::string& text)
    {
        return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    }
    static nlohmann::json json(const std::string& text) { return nlohmann::json::parse(text); }

    /// A project "game" with the scenes "One" (a falling box, a script) and "Two" (empty).
    void writeGame(const std::string& script = "print hello")
    {
        write("game/project.jet",
              "<jet-project version=\"1\" name=\"Game\">\n<filter name=\"F\"><scene name=\"One\" file=\"one.scene\"/>"
              "<scene name=\"Two\" file=\"two.scene\"/></filter>\n</jet-project>\n");
        write("game/one.scene", "<scene version=\"1\">\n<item type=\"body\" id=\"1\" name=\"Box\"><path>M 0 0 L 10 0 L "
                                "10 10 L 0 10 Z</path>"
                                "<effect type=\"box-body\"/></item>\n<item type=\"script\" id=\"2\" "
                                "name=\"Script\"><property id=\"code\">" +
                                    script + "</property></item>\n</scene>\n");
        write("game/two.scene", "<scene version=\"1\"/>\n");
    }

private:
    PluginFolder folder_, plugins_;
};

}  // namespace jet::test
