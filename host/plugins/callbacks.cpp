#include "callbacks.hpp"

#include <array>

namespace jet::host {

namespace {

// What the user waits for at each frame, at each input, now and then, or as long as it takes.
constexpr int kFrame = 100, kInput = 500, kLoading = 2000, kFree = 0;
constexpr int kHang = 3000, kLongWork = 30000;

constexpr std::array<CallbackInfo, static_cast<std::size_t>(Callback::Count)> kCallbacks{{
    {"no callback", kFree, kLongWork},
    {"load", kLoading, kHang},
    {"factory", kInput, kHang},
    {"event listener", kFrame, kHang},
    {"its own code", kFree, kLongWork},
    {"Tool::options", kInput, kHang},
    {"Tool::activate", kInput, kHang},
    {"Tool::deactivate", kInput, kHang},
    {"Tool::press", kInput, kHang},
    {"Tool::drag", kFrame, kHang},
    {"Tool::release", kInput, kHang},
    {"Tool::move", kFrame, kHang},
    {"Tool::doubleClick", kInput, kHang},
    {"Tool::wheel", kFrame, kHang},
    {"Tool::keyPress", kInput, kHang},
    {"Tool::keyRelease", kInput, kHang},
    {"Tool::cancel", kInput, kHang},
    {"Tool::paint", kFrame, kHang},
    {"Tool::~Tool", kInput, kHang},
    {"Effect::properties", kInput, kHang},
    {"Effect::rejects", kFrame, kHang},
    {"Effect::applied", kInput, kHang},
    {"Effect::update", kInput, kHang},
    {"Effect::paint", kFrame, kHang},
    {"Effect::buildBody", kInput, kHang},
    {"Effect::wantsLiveBody", kFrame, kHang},
    {"EffectState::~EffectState", kFrame, kHang},
    {"Effect::~Effect", kInput, kHang},
    {"ItemType::properties", kInput, kHang},
    {"ItemType::label", kFrame, kHang},
    {"ItemType::paint", kFrame, kHang},
    {"ItemType::build", kInput, kHang},
    {"ItemType::~ItemType", kInput, kHang},
    {"Importer::read", kFree, kLongWork},
    {"Importer::~Importer", kInput, kHang},
    {"Exporter::write", kFree, kLongWork},
    {"Exporter::~Exporter", kInput, kHang},
    {"PhysicsEngine::createWorld", kInput, kHang},
    {"PhysicsEngine::~PhysicsEngine", kInput, kHang},
    {"PhysicsWorld::add", kInput, kHang},
    {"PhysicsWorld::step", kFrame, kHang},
    {"PhysicsWorld, a query", kFrame, kHang},
    {"PhysicsWorld, a setter", kFrame, kHang},
    {"PhysicsWorld::save", kFrame, kHang},
    {"PhysicsWorld::restore", kFrame, kHang},
    {"PhysicsWorld::~PhysicsWorld", kInput, kHang},
    {"ScriptEngine::createRuntime", kInput, kHang},
    {"ScriptEngine::~ScriptEngine", kInput, kHang},
    {"ScriptRuntime::run", kInput, kHang},
    {"ScriptRuntime::dispatch", kFrame, kHang},
    {"ScriptRuntime::listensTo", kFrame, kHang},
    {"ScriptRuntime::~ScriptRuntime", kInput, kHang},
    {"Command::run", kFree, kLongWork},
    {"Command::isEnabled", kFrame, kHang},
    {"Command::~Command", kInput, kHang},
    {"Panel::createWidget", kInput, kHang},
    {"an event of its panel", kInput, kHang},
    {"Panel::~Panel", kInput, kHang},
}};

}  // namespace

const CallbackInfo& infoOf(Callback callback)
{
    const auto index = static_cast<std::size_t>(callback);
    return kCallbacks[index < kCallbacks.size() ? index : 0];
}

}  // namespace jet::host
