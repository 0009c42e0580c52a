// LiveScene: a scene that is played with one of the engines, with its bodies, joints, fields and scripts.
#pragma once

#include "support/test_catalog.hpp"

#include <jet/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace jet::test {

class LiveScene : public testing::Test {
protected:
    explicit LiveScene(const char* engine = "jet-physics") : scene_("Scene", events_, catalog_)
    {
        options_.physics = engine;
        hasEngine_ = options_.physics == "jet-physics";
        if (hasEngine_) return;
        try {
            catalog_.load("org.jet.physics-box2d");
            hasEngine_ = true;
        } catch (const Failure&) {  // built without it
        }
    }
    ItemId add(const char* type, Path path, const Properties& properties = {}, const char* effect = nullptr)
    {
        auto edit = scene_.items().begin("Add");
        const Item& item = edit.add(type, scene_.root(), std::move(path));
        if (effect) edit.addEffect(item, effect);
        for (const auto& [id, value] : properties.entries()) edit.set(item, id, value);
        edit.commit();
        return item.id();
    }
    ItemId box(const Box& bounds, const Properties& properties = {})
    {
        return add("shape", Path::rectangle(bounds), properties, "in-path-rigid-body");
    }
    /// A script that prints what it says, and what goes wrong.
    ItemId script(const std::string& code) { return add("script", {}, {{"code", code}}); }
    void name(ItemId item, const char* text)
    {
        auto edit = scene_.items().begin("Name");
        edit.set(*scene_.items().find(item), "name", text);
        edit.commit();
    }
    std::vector<std::string> printed() const
    {
        std::vector<std::string> lines;
        for (const OutputLine& line : simulation_->output()) lines.push_back(line.text);
        return lines;
    }
    void setScene(const char* id, Value value)
    {
        auto edit = scene_.items().begin("Scene");
        edit.setScene(id, std::move(value));
        edit.commit();
    }
    static Path line(std::initializer_list<Vec2> points) { return Path::polygon(std::vector<Vec2>(points), false); }
    Simulation& play(double seconds)
    {
        if (!simulation_) simulation_ = Simulation::start(scene_, options_).orThrow();
        const double until = simulation_->time() + seconds;
        while (simulation_->time() < until - 1e-9) simulation_->step();
        return *simulation_;
    }
    void set(ItemId item, const char* property, Value value) { simulation_->setItemProperty(item, property, value); }
    std::string refusal(ItemId item, const char* property, Value value)
    {
        try {
            set(item, property, std::move(value));
        } catch (const Failure& failure) {
            return failure.error().message;
        }
        return "accepted";
    }
    Vec2 velocity(ItemId item) { return simulation_->world().bodies().velocity[simulation_->bodyOf(item)]; }
    double omega(ItemId item) { return simulation_->world().bodies().omega[simulation_->bodyOf(item)]; }
    Vec2 place(ItemId item) { return simulation_->world().bodies().position[simulation_->bodyOf(item)]; }

    TestCatalog catalog_{"org.jet.physics",
                         "org.jet.items.physics",
                         "org.jet.effect.in-path-rigid-body",
                         "org.jet.effect.in-path-body",
                         "org.jet.effect.stroke",
                         "org.jet.script-duktape"};
    EventsCenter events_;
    Scene scene_;
    SimulationOptions options_;
    std::unique_ptr<Simulation> simulation_;
    bool hasEngine_ = false;
};

/// With each engine there is.
class LiveSceneOfEngine : public LiveScene, public testing::WithParamInterface<const char*> {
protected:
    LiveSceneOfEngine() : LiveScene(GetParam()) {}
    void SetUp() override
    {
        if (!hasEngine_) GTEST_SKIP() << "built without Box2D";
    }
};

}  // namespace jet::test
