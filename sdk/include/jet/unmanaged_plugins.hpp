// UnmanagedPlugins: the plugins center of a program without a plugin manager, such as a test: there is nothing to
// switch or install, and what is missing is explained by the catalog.
#pragma once

#include <jet/plugins.hpp>
#include <jet/settings.hpp>

namespace jet {

class UnmanagedPlugins final : public PluginsCenter {
public:
    /// The catalog outlives it.
    explicit UnmanagedPlugins(const Catalog& catalog) : catalog_(catalog) {}

    std::vector<PluginInfo> plugins() const override { return {}; }
    std::optional<PluginInfo> plugin(std::string_view) const override { return std::nullopt; }
    std::vector<std::string> dependents(std::string_view) const override { return {}; }
    std::vector<std::string> requirements(std::string_view) const override { return {}; }
    Result<PluginChange> setEnabled(std::string_view id, bool) override
    {
        return Error("the plugin " + std::string(id) + " cannot be switched here: no plugins are managed");
    }
    std::shared_ptr<Settings> settings(std::string_view) override { return nullptr; }
    Provider whoProvides(ContributionKind kind, std::string_view id) const override
    {
        Provider provider;
        provider.sentence = catalog_.explain(kind, id);
        return provider;
    }

private:
    const Catalog& catalog_;
};

}  // namespace jet
