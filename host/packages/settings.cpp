#include "settings.hpp"

#include <jet/format.hpp>

#include <cstdlib>
#include <functional>
#include <sstream>

namespace jet::host {

namespace fs = std::filesystem;

namespace {

/// Writes the file again without the lines that `drops` names; a missing file stays missing.
Result<void> filterLines(const fs::path& file, const std::function<bool(const std::string&)>& drops)
{
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return {};
    const auto text = readFile(file);
    if (!text) return text.error();
    std::istringstream lines(*text);
    std::string kept;
    for (std::string line; std::getline(lines, line);)
        if (!drops(line)) kept += line + "\n";
    return kept == *text ? Result<void>() : writeFileAtomically(file, kept);
}

}  // namespace

fs::path configurationFolder()
{
    if (const char* config = std::getenv("XDG_CONFIG_HOME"); config && *config) return fs::path(config) / "jet";
    const char* home = std::getenv("HOME");
    return home && *home ? fs::path(home) / ".config" / "jet" : fs::path();
}

Result<void> dropSettings(const Manifest& manifest, const fs::path& configuration)
{
    const auto listed =
        filterLines(configuration / "disabled-plugins", [&](const std::string& line) { return line == manifest.id; });
    if (!listed) return listed;
    if (isPluginId(manifest.id)) {
        const fs::path pages = configuration / "settings" / (manifest.id + ".json");
        std::error_code problem;
        fs::remove(pages, problem);
        if (problem) return Error("cannot be removed: " + problem.message(), Location{pages.string(), 0, 0});
    }
    // The window keeps the options of tools as "tool\option=..." in the section [tools].
    std::string section;
    return filterLines(configuration / "window.ini", [&](const std::string& line) {
        if (line.starts_with('[')) section = line;
        if (section != "[tools]") return false;
        for (const Contribution& one : manifest.contributions)
            if (one.kind == ContributionKind::Tool && line.starts_with(one.id + "\\")) return true;
        return false;
    });
}

}  // namespace jet::host
