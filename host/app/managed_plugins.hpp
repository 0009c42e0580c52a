// What the window asks about plugins, answered by the plugin manager.
#pragma once

#include "host/plugins/plugin_manager.hpp"
#include "host/window/plugin_runtime.hpp"

namespace jet::host {

class ManagedPlugins final : public PluginRuntime {
public:
    explicit ManagedPlugins(PluginManager& manager) : manager_(manager) {}

    void guardEvent(std::string_view plugin, const std::function<void()>& deliver) override;
    void showLife() override;
    bool isUsable(std::string_view plugin) const override;
    bool isInCall(std::string_view plugin) const override { return manager_.isInCall(plugin); }
    std::string ownerOf(const void* address) const override;
    void blame(std::string_view plugin, std::exception_ptr problem) override;
    std::filesystem::path folderOf(std::string_view plugin) const override;
    std::vector<std::string> loaded() const override;
    std::string titleOf(std::string_view plugin) const override;
    Result<void> reload(std::string_view plugin, const std::function<void()>& beforeSwap) override;
    Result<std::string> add(const std::filesystem::path& folder) override;

private:
    PluginManager& manager_;
};

}  // namespace jet::host
