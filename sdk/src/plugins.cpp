// What the contracts of settings and of the plugins center need in one place: key functions, names, defaults.
#include <jet/plugin.hpp>
#include <jet/plugins.hpp>
#include <jet/settings.hpp>

#include <mutex>

namespace jet {

std::string_view stateName(PluginState state)
{
    static constexpr std::string_view names[] = {"found",  "valid",    "resolved", "loaded",
                                                 "active", "disabled", "shadowed", "faulted"};
    return names[static_cast<int>(state)];
}

PluginsCenter::~PluginsCenter() = default;
Result<PluginChange> PluginsCenter::install(const std::filesystem::path&)
{
    return Error("this program cannot install plugins; use 'jet plugins install'");
}
Result<PluginChange> PluginsCenter::remove(std::string_view)
{
    return Error("this program cannot remove plugins; use 'jet plugins remove'");
}
Result<PluginChange> PluginsCenter::reload(std::string_view)
{
    return Error("this program cannot reload plugins; start it again");
}

std::vector<PluginSetInfo> PluginsCenter::sets() const { return {}; }
Result<PluginChange> PluginsCenter::useSet(std::string_view)
{
    return Error("this program has no plugin sets; start it with '--plugins SET'");
}
Result<PluginSetInfo> PluginsCenter::saveSet(std::string_view)
{
    return Error("this program cannot save plugin sets; use 'jet plugins freeze'");
}
std::vector<PluginDifference> PluginsCenter::differences(const Project&) const { return {}; }

Settings::~Settings() = default;

namespace {

class SettingsInMemory final : public Settings {
public:
    explicit SettingsInMemory(PropertyTable table) : table_(std::move(table)) {}
    const PropertyTable& table() const override { return table_; }
    Value value(std::string_view id) const override
    {
        const std::lock_guard lock(mutex_);
        return values_.get(id, table_);
    }
    Result<void> set(std::string_view id, Value value) override
    {
        const PropertySpec* spec = table_.find(id);
        if (!spec) return Error("There is no property \"" + std::string(id) + "\" here.");
        if (const auto fine = spec->check(value); !fine) return fine;
        const std::lock_guard lock(mutex_);
        values_.set(id, std::move(value));
        return {};
    }
    Result<void> reset(std::string_view id) override
    {
        const std::lock_guard lock(mutex_);
        values_.erase(id);
        return {};
    }

private:
    PropertyTable table_;
    mutable std::mutex mutex_;  // guards the values: plugins read them on any thread
    Properties values_;
};

}  // namespace

std::shared_ptr<Settings> settingsInMemory(PropertyTable table)
{
    return std::make_shared<SettingsInMemory>(std::move(table));
}

std::shared_ptr<Settings> PluginRegistrar::addSettingsPage(std::string_view, const PropertyTable& table)
{
    return settingsInMemory(table);
}

}  // namespace jet
