// Example projects with what no editor writes in them: each is refused with a place and a reason, or plays, and what it
// then says of its items are numbers. Nothing crashes, hangs, changes the project or leaves half a file. The same
// mutations come in every run; what fails is told with its seed.
#include "cli_fixture.hpp"

#include <random>
#include <regex>

namespace jet::test {

namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr int kSeconds = 20;  // a play of five steps takes a twentieth of one

class Mutator {
public:
    explicit Mutator(std::uint64_t seed) : random_(seed) {}

    std::size_t below(std::size_t end) { return random_() % end; }

    std::string mutated(std::string text)
    {
        for (std::size_t i = 1 + below(3); i > 0; --i) mutate(text);
        return text;
    }

private:
    static constexpr const char* kOdd[] = {
        "nan",        "inf",   "-inf", "abc",   "",      "true",  "99999999999999999999999",
        "4294967296", "-1",    "0",    "-0",    "1e308", "1e300", "-1e308",
        "1e-320",     "1e-12", "1e12", "-1e12", "1e31",  "1e7"};
    static constexpr const char* kProperties[][2] = {{"velocity", "1e30 -1e30"},
                                                     {"omega", "1e30"},
                                                     {"gravity-scale", "-1e30"},
                                                     {"one-sided", "1e-300 0"},
                                                     {"layer", "4294967296"},
                                                     {"material", "none"},
                                                     {"ks", "1e9"},
                                                     {"mass", "0"},
                                                     {"cell-size", "1e-6 1e-6"},
                                                     {"most-flow", "0.95"},
                                                     {"axis", "0 0"},
                                                     {"hertz", "1e4"},
                                                     {"length", "1e9"},
                                                     {"break-force", "1e-9"},
                                                     {"kind", "gear"},
                                                     {"reach", "-1"}};

    void mutate(std::string& text)
    {
        switch (below(8)) {
        case 0:
        case 1:
        case 2: return replaceOne(text, R"(-?[0-9]+(\.[0-9]+)?)", kOdd[below(std::size(kOdd))]);
        case 3: return replaceOne(text, ">[^<>\n]+<", std::string(">") + kOdd[below(std::size(kOdd))] + "<");
        case 4: return replaceOne(text, " [a-z]+=\"[^\"]*\"", "");
        case 5: return replaceOne(text, "\n[^\n]*", below(2) == 0 ? "" : "$&$&$&");
        case 6: {
            const auto& [id, value] = kProperties[below(std::size(kProperties))];
            return replaceOne(text, below(2) == 0 ? "</path>" : "<effect type=\"in-path[a-z-]*\">",
                              "$&<property id=\"" + std::string(id) + "\">" + value + "</property>");
        }
        default:
            if (below(4) == 0) return text.resize(below(text.size() + 1));
            if (!text.empty()) text[below(text.size())] = static_cast<char>(below(256));
        }
    }
    /// One of the places that match.
    void replaceOne(std::string& text, const std::string& pattern, const std::string& format)
    {
        const std::regex expression(pattern);
        const auto begin = std::sregex_iterator(text.begin(), text.end(), expression);
        const auto count = static_cast<std::size_t>(std::distance(begin, std::sregex_iterator()));
        if (count == 0) return;
        const std::smatch match = *std::next(begin, static_cast<std::ptrdiff_t>(below(count)));
        const std::string with = match.format(format);
        text = text.substr(0, static_cast<std::size_t>(match.position())) + with +
               text.substr(static_cast<std::size_t>(match.position() + match.length()));
    }

    std::mt19937_64 random_;
};

bool isNumber(const Json& value)
{
    if (value.is_array()) return std::all_of(value.begin(), value.end(), isNumber);
    return value.is_number() && std::isfinite(value.get<double>());
}

class HostileProjectTest : public CliTest {
protected:
    /// Plays "game" with all plugins that ship.
    Outcome play(const std::string& more = "")
    {
        fs::remove(home() / "state.json");
        return plain("play game --steps 5 --state state.json " + more, "timeout " + std::to_string(kSeconds));
    }
    void expectWholeState()
    {
        const Json state = Json::parse(read("state.json"), nullptr, false);
        ASSERT_FALSE(state.is_discarded()) << read("state.json");
        for (const Json& item : state["items"])
            for (const char* field : {"position", "angle", "velocity", "omega", "bounds"})
                EXPECT_TRUE(isNumber(item[field])) << item.dump();
    }
    void expectRefusedOrPlayed(const Outcome& outcome)
    {
        ASSERT_THAT(outcome.code, testing::AnyOf(0, 1)) << outcome.err;
        if (outcome.code == 0) return expectWholeState();
        EXPECT_THAT(outcome.err, HasSubstr("error: "));
        EXPECT_FALSE(exists("state.json")) << outcome.err;
    }
    void copyExample(const std::string& name)
    {
        fs::remove_all(home() / "game");
        fs::copy(fs::path(JET_SOURCE_DIR "/examples/physics") / name, home() / "game", fs::copy_options::recursive);
    }
    std::string scene() const
    {
        const fs::path file = fs::directory_iterator(home() / "game/scenes")->path();
        return fs::relative(file, home()).string();
    }
};

TEST_F(HostileProjectTest, MutatedProjectsAreRefusedWithAReasonOrPlayInNumbers)
{
    const std::string examples[] = {"breaking", "car",     "composite", "fields",     "gas",   "joints",
                                    "motors",   "plastic", "platform",  "soft-rigid", "stack", "tearing"};
    int played = 0, refused = 0;
    for (std::uint64_t seed = 0; seed < 120; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Mutator mutator(seed);
        copyExample(examples[seed % std::size(examples)]);
        const std::string file = mutator.below(8) == 0 ? "game/project.jet" : scene();
        const std::string text = mutator.mutated(read(file));
        write(file, text);
        const Outcome outcome = play(seed % 4 == 3 ? "--physics physics-box2d" : "");
        expectRefusedOrPlayed(outcome);
        EXPECT_EQ(read(file), text) << "playing only reads";
        ++(outcome.code == 0 ? played : refused);
        if (HasFailure()) {
            ADD_FAILURE() << outcome.err << "\n" << file << ":\n" << text.substr(0, 4000);
            return;
        }
    }
    EXPECT_GT(played, 5);  // else nothing was tried but the readers
    EXPECT_GT(refused, 5);
}

TEST_F(HostileProjectTest, APoisonedNumberIsToldWithItsPlace)
{
    for (const char* number : {"nan", "inf", "1e999", "abc", "-1"}) {
        copyExample("stack");
        std::string text = read(scene());
        const std::string mass = "<property id=\"mass\">";
        const std::size_t at = text.find(mass) + mass.size();
        text.replace(at, text.find('<', at) - at, number);
        write(scene(), text);
        const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
        const Outcome outcome = play();
        expectRefusedOrPlayed(outcome);
        EXPECT_EQ(outcome.code, 1) << number;
        EXPECT_THAT(outcome.err, HasSubstr(".scene:" + std::to_string(line) + ":")) << number;
    }
}

TEST_F(HostileProjectTest, AnOutlineTooIntricateForAnEngineIsToldWithItsItemAndTheRestPlays)
{
    for (const char* engine : {"jet-physics", "physics-box2d"}) {
        copyExample("stack");
        std::string text = read(scene());
        std::string scribble = "M 0 0";
        std::mt19937_64 random(1);
        for (int i = 0; i < 1500; ++i)
            scribble += " L " + std::to_string(random() % 640) + " " + std::to_string(random() % 360);
        const std::size_t at = text.find("<path>", text.find("name=\"Box 9\"")) + 6;
        text.replace(at, text.find('<', at) - at, scribble + " Z");
        write(scene(), text);
        const Outcome outcome = play(std::string("--physics ") + engine);
        EXPECT_EQ(outcome.code, 0) << engine << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("'Box 9': its body cannot be built")) << engine;
        expectWholeState();
    }
}

TEST_F(HostileProjectTest, ASpringThatAnEngineRefusesIsToldWithItsNameAndTheRestPlays)
{
    for (const char* engine : {"jet-physics", "physics-box2d"}) {
        copyExample("tearing");
        std::string text = read(scene());
        const std::string end = "116 70</path>";
        text.replace(text.find(end), end.size(), "1e13 70</path>");
        write(scene(), text);
        const Outcome outcome = play(std::string("--physics ") + engine);
        EXPECT_EQ(outcome.code, 0) << engine << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("Strong left rope")) << engine;
        EXPECT_THAT(outcome.err, HasSubstr("It does nothing")) << engine;
        expectWholeState();
    }
}

}  // namespace

}  // namespace jet::test
