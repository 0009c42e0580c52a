#include "user_choice.hpp"

#include <jet/format.hpp>

#include <cstdlib>
#include <sstream>

namespace jet::host {

namespace fs = std::filesystem;

fs::path userConfigFolder()
{
    if (const char* config = std::getenv("XDG_CONFIG_HOME"); config && *config) return fs::path(config) / "jet";
    const char* home = std::getenv("HOME");
    return home && *home ? fs::path(home) / ".config" / "jet" : fs::path();
}

std::set<std::string> readDisabledPlugins()
{
    std::set<std::string> ids;
    const fs::path file = userConfigFolder() / "disabled-plugins";
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return ids;
    const auto text = readFile(file);
    std::istringstream lines(text ? *text : std::string());
    for (std::string line; std::getline(lines, line);)
        if (!line.empty()) ids.insert(line);
    return ids;
}

Result<void> writeDisabledPlugins(const std::set<std::string>& ids)
{
    std::error_code ignored;
    fs::create_directories(userConfigFolder(), ignored);
    std::string text;
    for (const std::string& id : ids) text += id + "\n";
    return writeFileAtomically(userConfigFolder() / "disabled-plugins", text);
}

}  // namespace jet::host
