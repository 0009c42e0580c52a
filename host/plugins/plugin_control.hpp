// PluginControl: the PluginsCenter over the PluginManager: what the Plugins panel and the Settings dialog work with.
#pragma once

#include "plugin_manager.hpp"

#include <jet/events.hpp>
#include <jet/plugins.hpp>

namespace jet::host {

class PluginControl final : public PluginsCenter {
public:
    /// Both outlive it.
    PluginControl(PluginManager& manager, EventsCenter& events);
    ~PluginControl() override;

    std::vector<PluginInfo> plugins() const override;
    std::optional<PluginInfo> plugin(std::string_view id) const override;
    std::vector<std::string> dependents(std::string_view id) const override;
    std::vector<std::string> requirements(std::string_view id) const override;
    Result<PluginChange> setEnabled(std::string_view id, bool enabled) override;
    std::shared_ptr<Settings> settings(std::string_view page) override { return manager_.settings(page); }
    Provider whoProvides(ContributionKind kind, std::string_view id) const override;

private:
    PluginManager& manager_;
    EventsCenter& events_;
};

/// Bytes of this process that are mapped from the file. 0 where it is not mapped.
std::uint64_t mappedBytes(const std::filesystem::path& file);

}  // namespace jet::host
