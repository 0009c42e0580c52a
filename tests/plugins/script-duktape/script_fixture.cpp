#include "script_fixture.hpp"

#include "fake_physics.hpp"

#include <ctime>
#include <fstream>
#include <iterator>
#include <test_paths.hpp>

namespace jet::test {

std::string scriptFixture(const std::string& name)
{
    std::ifstream in(std::string(JET_SOURCE_DIR) + "/tests/fixtures/scripts/" + name, std::ios::binary);
    if (!in) throw std::runtime_error("no fixture " + name);
    return {std::istreambuf_iterator<char>(in), {}};
}

double processorMs()
{
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

ScriptTest::ScriptTest()
{
    catalog_.load("org.jet.script-duktape");
    catalog_.inCode().physicsEngine<FakePhysics>("fake");
    catalog_.inCode().effect<FakeBody>("fake-body");
    catalog_.inCode().itemType<FakeJoint>("fake-joint");
    catalog_.inCode().itemType<FakeForce>("fake-force");
    scene_ = std::make_unique<Scene>("Scene 0", events_, catalog_);
    auto edit = scene_->items().begin("Set up");
    edit.setScene("gravity", Vec2(0, 0));
    edit.commit();
}

ScriptTest::~ScriptTest() { simulation_.reset(); }

const Item& ScriptTest::add(std::string_view type, const std::string& name, Path path, const Item* parent)
{
    auto edit = scene_->items().begin("Add");
    const Item& item = edit.add(type, parent ? *parent : scene_->root(), std::move(path));
    edit.set(item, "name", name);
    edit.commit();
    return item;
}

const Item& ScriptTest::group(const std::string& name, const Item* parent) { return add("group", name, {}, parent); }

const Item& ScriptTest::shape(const std::string& name, const Item* parent)
{
    return add("shape", name, Path::rectangle(Box({0, 0}, {10, 20})), parent);
}

const Item& ScriptTest::body(const std::string& name, const Box& box, const Item* parent)
{
    const Item& item = add("body", name, Path::rectangle(box), parent);
    auto edit = scene_->items().begin("Add body");
    edit.addEffect(item, "fake-body");
    edit.commit();
    return item;
}

const Item& ScriptTest::torque(const std::string& name, const Vec2& at, const Item* parent)
{
    return add("torque", name, Path::rectangle(Box(at - Vec2(1, 1), at + Vec2(1, 1))), parent);
}

const Item& ScriptTest::script(const std::string& name, const std::string& code, const Item* parent)
{
    const Item& item = add("script", name, {}, parent);
    set(item, "code", Value(code));
    return item;
}

void ScriptTest::set(const Item& item, std::string_view property, Value value)
{
    auto edit = scene_->items().begin("Set");
    edit.set(item, property, std::move(value));
    edit.commit();
}

Simulation& ScriptTest::play(SimulationOptions options)
{
    simulation_ = Simulation::start(*scene_, std::move(options)).orThrow();
    return *simulation_;
}

void ScriptTest::step(int count)
{
    for (int i = 0; i < count; ++i) simulation_->step();
}

Lines ScriptTest::run(const std::string& code)
{
    script("Script", code);
    play();
    for (const OutputLine& line : simulation_->output()) EXPECT_EQ(line.kind, OutputLine::Kind::Text) << line.text;
    return printed();
}

Lines ScriptTest::printed() const
{
    Lines text;
    for (const OutputLine& line : simulation_->output()) text.push_back(line.text);
    return text;
}

std::vector<OutputLine> ScriptTest::lines(OutputLine::Kind kind) const
{
    std::vector<OutputLine> found;
    for (const OutputLine& line : simulation_->output())
        if (line.kind == kind) found.push_back(line);
    return found;
}

}  // namespace jet::test
