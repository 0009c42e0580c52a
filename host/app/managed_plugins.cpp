#include "managed_plugins.hpp"

namespace jet::host {

void ManagedPlugins::guardEvent(std::string_view plugin, const std::function<void()>& deliver)
{
    manager_.guardPanelEvent(plugin, deliver);
}

void ManagedPlugins::showLife()
{
    ThreadCalls* calls = CallBoard::hereIfAny();
    if (calls && calls->depth.load(std::memory_order_relaxed) > 0) calls->showLife();
}

bool ManagedPlugins::isUsable(std::string_view plugin) const
{
    const Plugin* found = manager_.plugin(plugin);
    return found && found->usable();
}

std::string ManagedPlugins::ownerOf(const void* address) const
{
    std::string id;
    CallAccount::with(CallBoard::ownerOf(address), [&](const Plugin& plugin, Guard&) { id = plugin.manifest.id; });
    return id;
}

void ManagedPlugins::blame(std::string_view plugin, std::exception_ptr problem)
{
    const Plugin* found = manager_.plugin(plugin);
    if (!found || !found->account) return;
    CallAccount::with(found->account->place(),
                      [&](Plugin& culprit, Guard& guard) { guard.fault(culprit, Callback::OwnCode, problem); });
}

std::filesystem::path ManagedPlugins::folderOf(std::string_view plugin) const
{
    const Plugin* found = manager_.plugin(plugin);
    return found ? found->folder : std::filesystem::path();
}

std::vector<std::string> ManagedPlugins::loaded() const
{
    std::vector<std::string> ids;
    for (const Plugin* plugin : manager_.plugins())
        if (plugin->library) ids.push_back(plugin->manifest.id);
    return ids;
}

std::string ManagedPlugins::titleOf(std::string_view plugin) const
{
    const Plugin* found = manager_.plugin(plugin);
    return found ? found->title() : std::string(plugin);
}

Result<void> ManagedPlugins::reload(std::string_view plugin, const std::function<void()>& beforeSwap)
{
    return manager_.reload(plugin, beforeSwap);
}

Result<std::string> ManagedPlugins::add(const std::filesystem::path& folder) { return manager_.takeIn(folder); }

}  // namespace jet::host
