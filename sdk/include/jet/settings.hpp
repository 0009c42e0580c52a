// Settings: what a user chooses once for a plugin, not per scene. A plugin declares a page in its manifest
// ("settingsPages"), gives its property table when it registers, and reads the values through what it gets back:
//
//   JET_PLUGIN(plugin)
//   {
//       const auto settings = plugin.settingsPage("rope", {jet::real("slack", "Slack", 0.1).range(0, 1)});
//       plugin.importer<RopeImporter>("rope", settings);      // RopeImporter(std::shared_ptr<jet::Settings>)
//   }
//
// The host keeps the values per plugin in $XDG_CONFIG_HOME/jet/settings; they survive disabling, removing and updating
// the plugin. The window shows each page in its Settings dialog, made from the table.
#pragma once

#include <jet/events.hpp>
#include <jet/property.hpp>

#include <memory>
#include <string>
#include <string_view>

namespace jet {

/// Sent by the host (sender: null listens to all) after a value of a page changed.
struct SettingsChanged {
    static constexpr EventType type{"org.jet.settings-changed"};
    std::string page, property;
};

/// The values of one settings page.
class JET_API Settings {
public:
    virtual ~Settings();

    virtual const PropertyTable& table() const = 0;
    /// The user's value, else the table's default; throws Failure for an id that is not in the table. [any thread]
    virtual Value value(std::string_view id) const = 0;
    template <class T>
    T get(std::string_view id) const
    {
        return value(id).as<T>();
    }
    /// Checks against the table, stores and tells. The error says what is wrong with the value, or why it could not be
    /// stored. [gui]
    virtual Result<void> set(std::string_view id, Value value) = 0;
    /// Back to the default. [gui]
    virtual Result<void> reset(std::string_view id) = 0;
};

/// A page that is kept in memory only: for tests and for hosts without a configuration.
JET_API std::shared_ptr<Settings> settingsInMemory(PropertyTable table);

}  // namespace jet
