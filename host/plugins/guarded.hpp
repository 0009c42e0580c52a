// Guarded contributions: each passes its calls on through the Guard. A guarded object keeps the plugin's own one alive.
#pragma once

#include "guard.hpp"

#include <jet/editor.hpp>
#include <jet/format.hpp>
#include <jet/item_type.hpp>
#include <jet/script.hpp>
#include <jet/simulation.hpp>
#include <jet/tool.hpp>
#include <jet/ui/panel.hpp>  // the interface needs no Qt

#include <memory>

namespace jet::host {

std::unique_ptr<Tool> guarded(Guard& guard, Plugin& plugin, std::unique_ptr<Tool> tool, ToolHost& host);
std::unique_ptr<Panel> guarded(Guard& guard, Plugin& plugin, std::unique_ptr<Panel> panel, Editor& editor);
std::shared_ptr<Effect> guarded(Guard& guard, Plugin& plugin, std::shared_ptr<Effect> effect);
std::shared_ptr<ItemType> guarded(Guard& guard, Plugin& plugin, std::shared_ptr<ItemType> type);
std::shared_ptr<Importer> guarded(Guard& guard, Plugin& plugin, std::shared_ptr<Importer> importer);
std::shared_ptr<Exporter> guarded(Guard& guard, Plugin& plugin, std::shared_ptr<Exporter> exporter);
std::shared_ptr<PhysicsEngine> guarded(Guard& guard, Plugin& plugin, std::shared_ptr<PhysicsEngine> engine);
std::shared_ptr<ScriptEngine> guarded(Guard& guard, Plugin& plugin, std::shared_ptr<ScriptEngine> engine);
std::shared_ptr<Command> guarded(Guard& guard, Plugin& plugin, std::shared_ptr<Command> command);

// Gives an object made by guarded() a new inside, from the reloaded plugin; null: nothing, it answers neutrally.
void renew(Effect& guarded, std::shared_ptr<Effect> effect);
void renew(ItemType& guarded, std::shared_ptr<ItemType> type);
void renew(Importer& guarded, std::shared_ptr<Importer> importer);
void renew(Exporter& guarded, std::shared_ptr<Exporter> exporter);
void renew(PhysicsEngine& guarded, std::shared_ptr<PhysicsEngine> engine);
void renew(ScriptEngine& guarded, std::shared_ptr<ScriptEngine> engine);
void renew(Command& guarded, std::shared_ptr<Command> command);

}  // namespace jet::host
