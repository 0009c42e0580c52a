// PluginControl: the PluginsCenter over the PluginManager: what the Plugins panel and the Settings dialog work with.
#pragma once

#include "plugin_manager.hpp"

#include <jet/events.hpp>
#include <jet/plugins.hpp>

#include <functional>

namespace jet::host {

/// How packages are installed and removed; empty: not at all.
struct PackageActions {
    struct Installed {
        std::string id;
        std::filesystem::path folder;
        std::string message;
    };
    std::function<Result<std::vector<Installed>>(const std::filesystem::path& file)> install;
    /// Answers the folder that was removed.
    std::function<Result<std::filesystem::path>(const std::string& id)> remove;
};

class PluginControl final : public PluginsCenter {
public:
    /// Both outlive it.
    PluginControl(PluginManager& manager, EventsCenter& events, PackageActions packages = {});
    ~PluginControl() override;

    std::vector<PluginInfo> plugins() const override;
    std::optional<PluginInfo> plugin(std::string_view id) const override;
    std::vector<std::string> dependents(std::string_view id) const override;
    std::vector<std::string> requirements(std::string_view id) const override;
    Result<PluginChange> setEnabled(std::string_view id, bool enabled) override;
    Result<PluginChange> install(const std::filesystem::path& file) override;
    Result<PluginChange> remove(std::string_view id) override;
    /// By setReloader(); refuses without one.
    Result<PluginChange> reload(std::string_view id) override;
    std::shared_ptr<Settings> settings(std::string_view page) override { return manager_.settings(page); }
    Provider whoProvides(ContributionKind kind, std::string_view id) const override
    {
        return manager_.whoProvides(kind, id);
    }
    std::vector<PluginSetInfo> sets() const override;
    Result<PluginChange> useSet(std::string_view name) override;
    Result<PluginSetInfo> saveSet(std::string_view name) override;
    std::vector<PluginDifference> differences(const Project& project) const override;

    /// Who swaps libraries and makes tools and panels anew: the window.
    void setReloader(std::function<Result<PluginChange>(const std::string& id)> reload) { reload_ = std::move(reload); }
    /// The project whose plugins.jetset can be chosen, and whose versions are preferred. Answers what is wrong with it.
    std::string setProject(const std::filesystem::path& project);

private:
    PluginSetInfo infoOf(const Result<PluginSet>& set, const std::string& name) const;
    void tell(const std::vector<std::string>& ids) { events_.post(this, PluginsChanged{ids}); }

    PluginManager& manager_;
    EventsCenter& events_;
    PackageActions packages_;
    std::function<Result<PluginChange>(const std::string&)> reload_;
    std::optional<PluginSet> startSet_;  // of the command line: has no name to find it by
    std::filesystem::path project_;
};

/// Bytes of this process that are mapped from the file. 0 where it is not mapped.
std::uint64_t mappedBytes(const std::filesystem::path& file);

}  // namespace jet::host
