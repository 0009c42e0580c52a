// Every way into a plugin, with its name for messages and the time it may take.
#pragma once

#include <cstdint>
#include <string_view>

namespace jet::host {

/// In the order of kCallbacks (callbacks.cpp). The number stands in crash ledgers: within one version only.
enum class Callback : std::uint16_t {
    None,
    Load,
    Factory,
    Listener,
    OwnCode,  // a thread, a timer, a static destructor: code of the plugin that the host did not call
    ToolOptions,
    ToolActivate,
    ToolDeactivate,
    ToolPress,
    ToolDrag,
    ToolRelease,
    ToolMove,
    ToolDoubleClick,
    ToolWheel,
    ToolKeyPress,
    ToolKeyRelease,
    ToolCancel,
    ToolPaint,
    ToolDestroy,
    EffectProperties,
    EffectRejects,
    EffectApplied,
    EffectUpdate,
    EffectPaint,
    EffectBuildBody,
    EffectWantsLiveBody,
    EffectStateDestroy,
    EffectDestroy,
    ItemTypeProperties,
    ItemTypeLabel,
    ItemTypePaint,
    ItemTypeBuild,
    ItemTypeDestroy,
    ImporterRead,
    ImporterDestroy,
    ExporterWrite,
    ExporterDestroy,
    EngineCreateWorld,
    EngineDestroy,
    WorldBuild,
    WorldStep,
    WorldRead,
    WorldAct,
    WorldSave,
    WorldRestore,
    WorldDestroy,
    ScriptsCreateRuntime,
    ScriptsDestroy,
    RuntimeRun,
    RuntimeDispatch,
    RuntimeListensTo,
    RuntimeDestroy,
    CommandRun,
    CommandIsEnabled,
    CommandDestroy,
    PanelCreateWidget,
    PanelEvent,
    PanelDestroy,
    Count
};

struct CallbackInfo {
    std::string_view name;  ///< "Tool::press"
    int budgetMs;           ///< longer calls are counted as overruns; 0: takes the time it needs
    int hangMs;             ///< after this the user is told that JET waits for the plugin
};

const CallbackInfo& infoOf(Callback callback);
inline std::string_view nameOf(Callback callback) { return infoOf(callback).name; }

}  // namespace jet::host
