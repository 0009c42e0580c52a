// Scene drop: things dragged from a panel onto a scene view. The panel's drag carries kSceneDrag with bytes of its own
// ("org.example.parts/7"); the view tells where it was dropped, and the panel, which knows its bytes, does the rest.
//
//   data->setData(jet::ui::kSceneDrag, "org.example.parts/7");                      // in the view's mimeData()
//   editor.events().subscribe<jet::ui::DroppedOnScene>(nullptr, [](const auto& drop) { ... });
#pragma once

#include <jet/scene.hpp>

#include <string>

namespace jet::ui {

/// The MIME type that scene views accept.
inline constexpr const char* kSceneDrag = "application/x-jet-scene-drag";

/// Sent by the Editor after a drop, with gestures in the scene ended.
struct DroppedOnScene {
    static constexpr EventType type{"org.jet.dropped-on-scene"};
    Scene* scene;
    Vec2 at;           ///< scene units
    std::string data;  ///< what the panel put under kSceneDrag
};

}  // namespace jet::ui
