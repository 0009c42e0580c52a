// jet-physics-conformance: what a physics engine plugin supports, and how well.
//
//   jet-physics-conformance [--physics ID] [--plugin-path DIR]... [--only TEXT] [--json FILE] [--markdown FILE]
//   [--known NAME]... [--bounds FILE]
//
// --bounds: a JSON object of an engine's own bounds by "group: name", tighter than those that hold for every engine, so
// that what it does well stays so.
//
// Loads the engine as `jet` does, by its id, guarded. Each check runs in a world of its own; what an engine refuses
// with a sentence is "not supported", what it computes beyond the bound "falls short". Exit code: 0 when nothing falls
// short but what --known names, 1 otherwise, and when --known names a check that does not fall short; 2 for bad usage.
#include "lab.hpp"

#include "host/plugins/plugin_manager.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <fstream>
#include <map>
#include <set>

namespace jet::conformance {

namespace {

using Verdict = Outcome::Verdict;

struct Options {
    std::string physics, only, json, markdown, bounds;
    std::vector<std::filesystem::path> pluginPath;
    std::set<std::string> known;
};

struct Row {
    std::string group, name;
    Outcome outcome;
    double boundOfAll = 0;  // engines; the outcome's own may be tighter
};

const char* word(Verdict verdict)
{
    switch (verdict) {
    case Verdict::Supported: return "supported";
    case Verdict::Missing: return "not supported";
    case Verdict::Short: return "falls short";
    }
    return "";
}

std::string number(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, value != 0 && (value < 1e-3 || value >= 1e5) ? "%.1e" : "%.3g", value);
    return text;
}

std::string howWell(const Outcome& o)
{
    if (o.verdict == Verdict::Missing || o.unit.empty()) return {};
    return number(o.value) + " " + o.unit + " (at most " + number(o.bound) + ")";
}

/// The first sentence of a refusal is enough.
std::string refusal(const std::string& message)
{
    const std::size_t end = message.find_first_of(".;");
    return message.substr(0, end);
}

using Bounds = std::map<std::string, double>;

Bounds readBounds(const std::string& file)
{
    if (file.empty()) return {};
    std::ifstream in(file);
    if (!in) throw std::runtime_error("The bounds could not be read from " + file + ".");
    return nlohmann::json::parse(in).get<Bounds>();
}

/// An engine's own bound of a check; it must be the tighter one.
void tighten(Outcome& outcome, double bound, const std::string& name)
{
    if (outcome.verdict == Verdict::Missing)
        outcome = {Verdict::Short, 0, 0, {}, "has a bound of its own, and is refused: " + outcome.note};
    // What is measured is told by a unit that some failures lack.
    if (outcome.verdict == Verdict::Short) return;
    if (outcome.unit.empty() || bound >= outcome.bound)
        throw std::runtime_error("The bound of \"" + name + "\" is no tighter than the one of all engines.");
    outcome.bound = bound;
    if (outcome.value > bound) outcome.verdict = Verdict::Short;
}

std::vector<Row> runAll(const Lab& lab, const Options& options)
{
    Bounds own = readBounds(options.bounds);
    std::vector<Row> rows;
    for (const auto& checks : {motionChecks(), contactChecks(), changeChecks(), removalChecks(), jointChecks(),
                               softChecks(), queryChecks(), stateChecks()})
        for (const Check& check : checks) {
            const std::string name = check.group + ": " + check.name;
            const Bounds::node_type tighter = own.extract(name);
            if (name.find(options.only) == std::string::npos) continue;
            Row row{check.group, check.name, {}, 0};
            try {
                row.outcome = check.run(lab);
            } catch (const Failure& failure) {
                row.outcome = {Verdict::Missing, 0, 0, {}, refusal(failure.error().message)};
            } catch (const std::exception& e) {
                row.outcome = {Verdict::Short, 0, 0, {}, std::string("an exception: ") + e.what()};
            }
            row.boundOfAll = row.outcome.bound;
            if (tighter) tighten(row.outcome, tighter.mapped(), name);
            std::printf("%-24s %-32s %-14s %s%s%s\n", row.group.c_str(), row.name.c_str(), word(row.outcome.verdict),
                        howWell(row.outcome).c_str(), row.outcome.note.empty() || row.outcome.unit.empty() ? "" : "; ",
                        row.outcome.note.c_str());
            std::fflush(stdout);
            rows.push_back(std::move(row));
        }
    if (!own.empty()) throw std::runtime_error("--bounds: there is no check \"" + own.begin()->first + "\".");
    return rows;
}

void writeJson(const std::string& file, const std::string& engine, const std::vector<Row>& rows)
{
    using Json = nlohmann::ordered_json;
    Json out{{"physics", engine}, {"checks", Json::array()}};
    for (const Row& row : rows)
        out["checks"].push_back(Json{{"group", row.group},
                                     {"name", row.name},
                                     {"verdict", word(row.outcome.verdict)},
                                     {"value", row.outcome.value},
                                     {"bound", row.outcome.bound},
                                     {"bound_of_all", row.boundOfAll},
                                     {"unit", row.outcome.unit},
                                     {"note", row.outcome.note}});
    std::ofstream(file) << out.dump(1) << "\n";
}

void writeMarkdown(const std::string& file, const std::vector<Row>& rows)
{
    std::ofstream out(file);
    out << "| | check | | how well |\n|---|---|---|---|\n";
    std::string group;
    for (const Row& row : rows) {
        const std::string well = howWell(row.outcome);
        out << "| " << (row.group == group ? "" : row.group) << " | " << row.name << " | " << word(row.outcome.verdict)
            << " | " << well << (well.empty() || row.outcome.note.empty() ? "" : "; ") << row.outcome.note << " |\n";
        group = row.group;
    }
}

int conclude(const std::vector<Row>& rows, const Options& options)
{
    int supported = 0, missing = 0, fallsShort = 0, unexpected = 0;
    std::set<std::string> unneeded = options.known;
    for (const Row& row : rows) {
        supported += row.outcome.verdict == Verdict::Supported;
        missing += row.outcome.verdict == Verdict::Missing;
        if (row.outcome.verdict != Verdict::Short) continue;
        ++fallsShort;
        unexpected += !options.known.contains(row.name);
        unneeded.erase(row.name);
    }
    std::printf("%d supported, %d not supported, %d fall short (%d of them not known)\n", supported, missing,
                fallsShort, unexpected);
    // An exemption that outlives its reason would hide the next failure.
    for (const std::string& name : unneeded)
        std::fprintf(stderr, "error: --known \"%s\": no check of this name that was run falls short.\n", name.c_str());
    return unexpected > 0 || !unneeded.empty() || rows.empty() ? 1 : 0;
}

int examine(const Options& options)
{
    host::PluginOptions plugins;
    plugins.builtIn = host::builtInPluginFolder();
    plugins.searchPath = options.pluginPath;
    plugins.searchPath.push_back(plugins.builtIn);
    host::PluginManager manager(std::move(plugins));
    manager.scan();
    PhysicsEngine* engine = manager.physicsEngine(options.physics);
    if (!engine) {
        std::fprintf(stderr,
                     "error: %s Installed:", manager.explain(ContributionKind::PhysicsEngine, options.physics).c_str());
        for (const Contribution& one : manager.contributions(ContributionKind::PhysicsEngine))
            std::fprintf(stderr, " %s (%s)", one.id.c_str(), one.label.c_str());
        std::fprintf(stderr, "\n");
        return 1;
    }
    const std::vector<Row> rows = runAll(Lab(*engine), options);
    if (!options.json.empty()) writeJson(options.json, options.physics, rows);
    if (!options.markdown.empty()) writeMarkdown(options.markdown, rows);
    return conclude(rows, options);
}

}  // namespace

}  // namespace jet::conformance

int main(int argc, char** argv)
{
    jet::conformance::Options options;
    options.physics = "jet-physics";
    CLI::App app("What a physics engine plugin supports, and how well", "jet-physics-conformance");
    app.add_option("--physics", options.physics, "Id of the engine")->type_name("ID");
    app.add_option("--plugin-path", options.pluginPath, "Folder of plugins to look into first; may repeat")
        ->type_name("DIR");
    app.add_option("--only", options.only, "Checks whose \"group: name\" contains the text")->type_name("TEXT");
    app.add_option("--json", options.json, "Writes the table as JSON")->type_name("FILE");
    app.add_option("--markdown", options.markdown, "Writes the table as Markdown")->type_name("FILE");
    app.add_option("--known", options.known,
                   "A check known to fall short, no failure (but one if it does not fall short); may repeat")
        ->type_name("NAME");
    app.add_option("--bounds", options.bounds, "The engine's own bounds, tighter ones, as JSON")->type_name("FILE");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& problem) {
        return app.exit(problem) == 0 ? 0 : 2;
    }
    try {
        return jet::conformance::examine(options);
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "error: %s\n", problem.what());
        return 1;
    }
}
