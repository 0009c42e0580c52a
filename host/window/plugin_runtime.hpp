// PluginRuntime: what the window asks of the host about plugins beyond what they contribute: guarding the events their
// widgets get, and reloading them. The window knows plugins by their ids only.
#pragma once

#include <jet/result.hpp>

#include <exception>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace jet::host {

/// A run that ended inside a plugin, for the window to ask about.
struct CrashNote {
    std::string plugin;   ///< id
    std::string message;  ///< a sentence
};

class PluginRuntime {
public:
    virtual ~PluginRuntime() = default;

    /// Delivers an event to a widget of the plugin as a guarded call: what `deliver` throws faults the plugin.
    virtual void guardEvent(std::string_view plugin, const std::function<void()>& deliver) = 0;
    /// Events are being handled: who waits for a plugin waits for the user, too (a dialog).
    virtual void showLife() = 0;
    virtual bool isUsable(std::string_view plugin) const = 0;
    /// Is it in the middle of a call?
    virtual bool isInCall(std::string_view plugin) const = 0;
    /// The plugin this address (of code, of a table of virtual functions) lies in; empty: none.
    virtual std::string ownerOf(const void* address) const = 0;
    /// Something of the plugin threw where no guard was.
    virtual void blame(std::string_view plugin, std::exception_ptr problem) = 0;

    /// Folder of the plugin; empty when it is not known.
    virtual std::filesystem::path folderOf(std::string_view plugin) const = 0;
    /// Ids of the plugins whose libraries are in use.
    virtual std::vector<std::string> loaded() const = 0;
    /// "Rectangle (org.jet.tool.rectangle 1.0.0)".
    virtual std::string titleOf(std::string_view plugin) const = 0;
    /// See PluginManager::reload() and takeIn().
    virtual Result<void> reload(std::string_view plugin, const std::function<void()>& beforeSwap) = 0;
    virtual Result<std::string> add(const std::filesystem::path& folder) = 0;
};

}  // namespace jet::host
