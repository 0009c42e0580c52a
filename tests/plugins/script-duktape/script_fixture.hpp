// ScriptTest: builds a scene, plays it with the built plugin, looks at what was printed.
//
//   body("Ball", Box({0, 0}, {10, 10}));
//   script("Control", "print(ItemUtils.getItemByName('Ball', ItemUtils.getTopGroup(script)).body.angle)");
//   play();
//   EXPECT_EQ(printed(), Lines{"0"});
#pragma once

#include "support/test_catalog.hpp"

#include <jet/scene.hpp>
#include <jet/simulation.hpp>

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace jet::test {

using Lines = std::vector<std::string>;

/// The text of tests/fixtures/scripts/<name>.
std::string scriptFixture(const std::string& name);
/// Milliseconds of processor time this thread has used: what limits are tested by, on however busy a computer.
double processorMs();

class ScriptTest : public testing::Test {
protected:
    ScriptTest();
    ~ScriptTest() override;

    // The scene. Without a parent items go to the top group.
    const Item& group(const std::string& name, const Item* parent = nullptr);
    const Item& shape(const std::string& name, const Item* parent = nullptr);
    const Item& body(const std::string& name, const Box& box, const Item* parent = nullptr);
    const Item& torque(const std::string& name, const Vec2& at, const Item* parent = nullptr);
    const Item& script(const std::string& name, const std::string& code, const Item* parent = nullptr);
    const Item& add(std::string_view type, const std::string& name, Path path, const Item* parent);
    void set(const Item& item, std::string_view property, Value value);

    /// Starts the simulation; scripts run. 60 steps a second, no gravity.
    Simulation& play(SimulationOptions options = {});
    Simulation& simulation() { return *simulation_; }
    void step(int count = 1);
    /// Plays a scene with this one script, in which nothing may go wrong, and returns what it printed.
    Lines run(const std::string& code);

    /// All lines so far, of any kind, as text.
    Lines printed() const;
    std::vector<OutputLine> lines(OutputLine::Kind kind) const;
    std::vector<OutputLine> errors() const { return lines(OutputLine::Kind::Error); }

    TestCatalog catalog_;
    EventsCenter events_;
    std::unique_ptr<Scene> scene_;
    std::unique_ptr<Simulation> simulation_;
};

}  // namespace jet::test
