// The reference is true: sdk/share/jet.d.ts declares what the engine has, no more and no less, and the examples of
// docs/script-api.md run.
#include "script_fixture.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <test_paths.hpp>

namespace jet::test {

namespace {

using Names = std::set<std::string>;

std::string sourceFile(const std::string& path)
{
    std::ifstream in(std::string(JET_SOURCE_DIR) + "/" + path, std::ios::binary);
    EXPECT_TRUE(in) << path;
    return {std::istreambuf_iterator<char>(in), {}};
}

Names words(const std::string& text)
{
    std::istringstream in(text);
    return {std::istream_iterator<std::string>(in), {}};
}

// What the language itself has in Duktape 2.7, after what heap.cpp and prelude.js take away.
const Names& languageGlobals()
{
    static const Names names = words(
        "globalThis NaN Infinity undefined Object Function Array String Boolean Number Date RegExp Error EvalError "
        "RangeError "
        "ReferenceError SyntaxError TypeError URIError Math JSON Proxy Reflect Symbol ArrayBuffer DataView Int8Array "
        "Uint8Array "
        "Uint8ClampedArray Int16Array Uint16Array Int32Array Uint32Array Float32Array Float64Array parseInt parseFloat "
        "TextEncoder TextDecoder eval isNaN isFinite decodeURI decodeURIComponent encodeURI encodeURIComponent escape "
        "unescape");
    return names;
}

// Declarations of jet.d.ts: `declare var|class|function NAME`, `interface NAME`, each with its members one level deep.
struct Typings {
    Names globals;
    std::map<std::string, Names> members;
};

// The text without comments.
std::string code(const std::string& text)
{
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool block = text.compare(i, 2, "/*") == 0;
        if (!block && text.compare(i, 2, "//") != 0) {
            out += text[i];
            continue;
        }
        const std::size_t end = block ? text.find("*/", i) + 2 : text.find('\n', i);
        i = std::min(end, text.size()) - 1;
    }
    return out;
}

// The name at `at`; empty where there is none.
std::string nameAt(const std::string& line, std::size_t at)
{
    std::size_t end = at;
    while (end < line.size() && (std::isalnum(static_cast<unsigned char>(line[end])) || line[end] == '_')) ++end;
    return line.substr(at, end - at);
}

Typings readTypings()
{
    Typings typings;
    std::istringstream in(code(sourceFile("sdk/share/jet.d.ts")));
    std::string current;
    const std::string indent(4, ' ');
    for (std::string line; std::getline(in, line);) {
        for (const char* start : {"declare var ", "declare class ", "declare function ", "interface "}) {
            if (!line.starts_with(start)) continue;
            current = nameAt(line, std::string(start).size());
            if (line.starts_with("declare")) typings.globals.insert(current);
            typings.members[current];
        }
        const std::string readOnly = indent + "readonly ";
        const std::size_t at = line.starts_with(readOnly) ? readOnly.size()
                               : line.starts_with(indent) ? indent.size()
                                                          : 0;
        const std::string name = at ? nameAt(line, at) : "";
        if (name.empty() || name == "constructor") continue;
        const char after = line[at + name.size()];
        if (after == ':' || after == '(') typings.members[current].insert(name);
    }
    return typings;
}

}  // namespace

class ScriptReferenceTest : public ScriptTest {
protected:
    void buildScene()
    {
        const Item& hero = group("Hero");
        body("Ball", Box({0, 0}, {20, 20}), &hero);
        body("Finish", Box({10, 10}, {40, 40}), &hero);
        torque("BallTorque", {10, 10}, &hero);
        add("spring", "Rope", Path::line({0, 0}, {10, 0}), &hero);
        add("fake-force", "Push", Path::line({10, 10}, {20, 10}), &hero);
        add("fake-joint", "Axle", Path::line({10, 10}, {90, 10}), &hero);
        shape("Score", &hero);
        shape("Background");
    }
};

TEST_F(ScriptReferenceTest, TheTypingsDeclareExactlyTheGlobalsThatExist)
{
    const Lines lines = run("print(Object.getOwnPropertyNames(globalThis).join(' '));");
    Names existing = words(lines.at(0));
    for (const std::string& name : languageGlobals())
        EXPECT_EQ(existing.erase(name), 1u) << name << " is not in the language";
    EXPECT_EQ(existing, readTypings().globals);
}

TEST_F(ScriptReferenceTest, TheTypingsDeclareExactlyTheMembersThatExist)
{
    buildScene();
    const std::pair<const char*, const char*> samples[] = {{"Vec2d", "new Vec2d()"},
                                                           {"BoundingArea", "ball.getBoundingArea()"},
                                                           {"Item", "ball"},
                                                           {"Body", "ball.body"},
                                                           {"Torque", "find('BallTorque').torque"},
                                                           {"Spring", "find('Rope').spring"},
                                                           {"Force", "find('Push').force"},
                                                           {"Joint", "find('Axle').joint"},
                                                           {"JetSystem", "JetSystem"},
                                                           {"ItemUtils", "ItemUtils"},
                                                           {"Keyboard", "Keyboard"},
                                                           {"Key", "Keyboard.getKey('A')"},
                                                           {"CC", "CC"},
                                                           {"Scene", "CC.getScene('Scene 0')"},
                                                           {"SceneView", "CC.getScene('Scene 0').GC.swingSimulationGP"},
                                                           {"ctx", "ctx"},
                                                           {"System", "System"},
                                                           {"console", "console"}};
    std::string code = R"(
        function find(name) { return ItemUtils.getItemByName(name, ItemUtils.getTopGroup(script)); }
        var ball = find('Ball');
        function members(o) {
            var names = [];
            for (; o && o !== Object.prototype; o = Object.getPrototypeOf(o))
                Object.getOwnPropertyNames(o).forEach(function (n) { if (n !== 'constructor') names.push(n); });
            print(names.join(' '));
        }
    )";
    for (const auto& [type, sample] : samples) code += std::string("members(") + sample + ");\n";
    const Lines lines = run(code);
    const Typings typings = readTypings();
    ASSERT_EQ(lines.size(), std::size(samples));
    for (std::size_t i = 0; i < lines.size(); ++i)
        EXPECT_EQ(typings.members.at(samples[i].first), words(lines[i])) << samples[i].first;
}

TEST_F(ScriptReferenceTest, EventsHaveTheMembersThatTheTypingsDeclare)
{
    buildScene();
    script("Script", R"(
        ['onStep', 'onKeyDown', 'onPointerDown', 'onBodyCollision', 'onContactBegin', 'onContactEnd'].forEach(function (type) {
            JetSystem.addEventListener(type, function (e) { print(Object.keys(e).join(' ')); });
        });
    )");
    play();
    simulation().key({"A", "a", {}, false}, true);
    simulation().pointer(ScriptEventKind::PointerDown, {});
    step();
    simulation().world().setPosition(0, {500, 0});
    simulation().world().setPosition(1, {500, 500});
    simulation().restore(simulation().save());  // the fake has no events of its own: what touches now is looked at
    step();
    const Typings typings = readTypings();
    const char* const types[] = {"KeyboardEvent",  "PointerEvent", "StepEvent",      "ContactBeginEvent",
                                 "CollisionEvent", "StepEvent",    "ContactEndEvent"};
    ASSERT_EQ(printed().size(), std::size(types));
    for (std::size_t i = 0; i < std::size(types); ++i) {
        Names declared = typings.members.at(types[i]);
        declared.insert("type");
        EXPECT_EQ(declared, words(printed()[i])) << types[i];
    }
}

TEST_F(ScriptReferenceTest, EveryDeclarationTellsSinceWhen)
{
    std::istringstream in(sourceFile("sdk/share/jet.d.ts"));
    std::string before;
    for (std::string line; std::getline(in, line); before = line) {
        if (line.starts_with("declare ") || line.starts_with("interface ") || line.starts_with("type ")) {
            EXPECT_NE(before.find("@since 0."), std::string::npos) << line;
        }
    }
}

// All ```js blocks, each as a script of its own in one scene, then played for a second with keys and pointer.
TEST_F(ScriptReferenceTest, TheExamplesOfTheReferenceRun)
{
    buildScene();
    const std::string text = sourceFile("docs/script-api.md");
    const Item& hero = *findByName(scene_->root(), "Hero");
    int count = 0;
    for (std::size_t at = text.find("```js\n"); at != std::string::npos; at = text.find("```js\n", at + 1)) {
        const std::size_t begin = at + 6;
        script("Example " + std::to_string(++count), text.substr(begin, text.find("```", begin) - begin), &hero);
    }
    EXPECT_GT(count, 10);
    Scene menu("Menu", events_, catalog_);
    SimulationOptions options;
    options.sceneByName = [&](std::string_view name) { return name == "Menu" ? &menu : nullptr; };
    play(options);
    for (int i = 0; i < 60; ++i) {
        simulation().key({"Space", " ", {}, false}, i % 2 == 0);
        simulation().pointer(ScriptEventKind::PointerDown, {{5, 5}, {5, 5}, PointerButton::Left, {}});
        simulation().pointer(ScriptEventKind::PointerMove, {{6, 5}, {6, 5}, PointerButton::Left, {}});
        step();
    }
    for (const OutputLine& line : simulation().output()) EXPECT_NE(line.kind, OutputLine::Kind::Error) << line.text;
    EXPECT_TRUE(errors().empty());
}

}  // namespace jet::test
