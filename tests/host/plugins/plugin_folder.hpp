// A temporary folder of plugins for one test: manifests written by the test, libraries linked from the built fixtures.
#pragma once

#include <jet/version.hpp>
#include <test_paths.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace jet::test {

inline std::filesystem::path fixtureFolder() { return std::filesystem::path(JET_BINARY_DIR) / "tests/plugins"; }

class PluginFolder {
public:
    PluginFolder()
    {
        std::string name = (std::filesystem::temp_directory_path() / "jet-plugins-XXXXXX").string();
        path_ = ::mkdtemp(name.data());
    }
    ~PluginFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    PluginFolder(const PluginFolder&) = delete;
    PluginFolder& operator=(const PluginFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

    /// Writes <folder>/<name>/plugin.json.
    void write(const std::string& name, const std::string& manifest)
    {
        std::filesystem::create_directories(path_ / name);
        std::ofstream(path_ / name / "plugin.json") << manifest;
    }
    /// A complete manifest with one effect named like the plugin's last part; `more` goes before the contributions.
    void add(const std::string& id, const std::string& more = "", const std::string& version = "1.0.0",
             const std::string& folder = "")
    {
        write(folder.empty() ? id : folder,
              "{ \"id\": \"" + id + "\", \"name\": \"" + id + "\", \"version\": \"" + version +
                  "\", \"jet\": \"" JET_SDK_VERSION
                  "\",\n  \"library\": \"none\", \"builtFor\": { \"sdk\": \"" JET_SDK_VERSION
                  "\", \"abi\": \"" JET_ABI_TAG "\" },\n  " +
                  more + (more.empty() ? "" : ",\n  ") + "\"contributes\": { \"effects\": [ { \"id\": \"" +
                  id.substr(id.rfind('.') + 1) + "\", \"label\": \"x\" } ] } }\n");
    }
    /// A built fixture, under its own id.
    void link(const std::string& id) { std::filesystem::create_directory_symlink(fixtureFolder() / id, path_ / id); }
    void remove(const std::string& name) { std::filesystem::remove_all(path_ / name); }

private:
    std::filesystem::path path_;
};

}  // namespace jet::test
