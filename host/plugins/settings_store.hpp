// SettingsStore: the values of plugins' settings pages, one file a plugin: <folder>/<plugin id>.json, as
// { "page": { "property": "value as text" } }. Files of plugins that are not installed stay untouched.
#pragma once

#include <jet/settings.hpp>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace jet::host {

class SettingsStore {
public:
    /// An empty folder: values are kept in memory.
    explicit SettingsStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// The page with what is stored for it. A stored value the table does not admit any more counts as not set; it
    /// stays in the file until the user sets another one.
    std::shared_ptr<Settings> page(const std::string& plugin, const std::string& page, const PropertyTable& table);

    /// Told after a value changed. [gui]
    std::function<void(const SettingsChanged&)> onChanged;

private:
    std::filesystem::path folder_;
};

}  // namespace jet::host
