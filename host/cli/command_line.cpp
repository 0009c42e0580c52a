#include "check_commands.hpp"
#include "commands.hpp"
#include "debug_marks.hpp"
#include "package_commands.hpp"
#include "packed_commands.hpp"
#include "plugin_new_command.hpp"
#include "project_check_command.hpp"
#include "recovery_commands.hpp"
#include "set_commands.hpp"

#include "host/plugins/suggest.hpp"

#include <jet/scene.hpp>
#include <jet/version.hpp>

#include <CLI/CLI.hpp>

#include <charconv>
#include <cstdio>
#include <limits>

namespace jet::host {

namespace {

void addGlobal(CLI::App& app, GlobalOptions& global)
{
    app.add_option("--plugins", global.set,
                   "Use these plugins only: sets by name or .jetset file, and ids of plugins, separated by commas")
        ->type_name("SET|FILE|ID,...");
    app.add_flag("--frozen", global.frozen, "Fail unless the plugins are in the exact versions that are recorded");
    app.add_option("--plugin-path", global.pluginPath, "Folder of further plugins")
        ->type_name("DIR")
        ->take_all()
        ->allow_extra_args(false);
    app.add_option("--without", global.without, "As if this plugin were not installed")
        ->type_name("ID")
        ->take_all()
        ->allow_extra_args(false);
    app.add_flag("--safe-mode", global.safeMode, "Only the plugins that ship with JET");
    app.add_flag("--trust", global.trust, "Trust the plugins that come with the project, from now on");
    app.add_flag("--json", global.json, "Print for a machine");
    app.add_flag("--verbose", global.verbose, "Say more");
}

/// Whole numbers only; the library's own conversion takes "-1" and "" for numbers, and what is too large for the most.
std::string seedFault(std::string& text)
{
    std::uint64_t seed = 0;
    const char* const end = text.data() + text.size();
    const auto [at, problem] = std::from_chars(text.data(), end, seed);
    if (problem == std::errc() && at == end) return {};
    return "'" + text + "' is no seed; give a whole number from 0 to " +
           std::to_string(std::numeric_limits<std::uint64_t>::max());
}

/// As the scene's own setting may be.
std::string timeStepFault(std::string& text)
{
    const PropertySpec& setting = *Scene::settingsTable().find("time-step");
    double seconds = 0;
    if (CLI::detail::lexical_cast(text, seconds) && setting.check(seconds)) return {};
    return "'" + text + "' is no time of a step; give seconds from " + numberText(setting.minimum) + " to " +
           numberText(setting.maximum);
}

std::string debugFault(std::string& text)
{
    const auto marks = host::debugMarks(text);
    return marks ? std::string() : marks.error().message;
}

/// In scripts it comes of a variable that is not set: files would go unwritten, or into the folder one is in.
void refuseEmptyValues(CLI::App& app)
{
    const auto fault = [](std::string& text) {
        return text.empty() ? std::string("is empty; give it a value, or leave it out") : std::string();
    };
    for (CLI::Option* option : app.get_options())
        if (option->get_type_size_max() > 0) option->check(CLI::Validator(fault, ""));
    for (CLI::App* command : app.get_subcommands({})) refuseEmptyValues(*command);
}

struct Parsed {
    PlayOptions play;
    ConvertOptions convert;
    std::string plugin, contribution;
    std::filesystem::path project;
    bool revoke = false;
    std::function<int(Session&)> run;  // of the chosen command; empty: the editor
};

void addPlay(CLI::App& app, Parsed& parsed)
{
    auto& o = parsed.play;
    auto* play = app.add_subcommand("play", "Play a project's scene without a window");
    play->add_option("project", o.project, "Project folder, .jet or .jetz file")->required()->type_name("PROJECT");
    play->add_option("--scene", o.scene, "Scene by name, or by number from 0; the first if not given")->type_name("N");
    play->add_option("--steps", o.steps, "Number of steps")
        ->type_name("N")
        ->capture_default_str()
        ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1'000'000'000}));
    play->add_option("--dt", o.timeStep, "Seconds a step instead of the scene's")
        ->type_name("S")
        ->check(CLI::Validator(timeStepFault, ""));
    play->add_option("--input", o.input, "Recorded keys to play back")->type_name("FILE");
    auto* snapshot = play->add_option("--snapshot", o.snapshot, "Picture of the last step, through the game's camera");
    snapshot->type_name("PNG");
    play->add_option("--debug", o.debug,
                     "What the picture shows of the physics: contacts, islands, stress, boxes, centres, joints, or all")
        ->type_name("WORD,...")
        ->needs(snapshot)
        ->check(CLI::Validator(debugFault, ""));
    play->add_option("--state", o.state, "State after the last step, as JSON")->type_name("JSON");
    play->add_option("--record", o.record, "Write what was played, with a hash a second")->type_name("FILE");
    play->add_option("--seed", o.seed, "Seed of the scripts' random numbers")
        ->type_name("N")
        ->check(CLI::Validator(seedFault, ""));
    play->add_option("--threads", o.threads, "Threads the physics engine may use")
        ->type_name("N")
        ->check(CLI::Range(1, 64));
    play->add_option("--physics", o.physics,
                     "Physics engine instead of the scene's, or its plugin; 'jet plugins list' has them")
        ->type_name("ID");
    play->add_option("--width", o.width,
                     "Width of the view in pixels, 1280 if not given; the picture shows the page then")
        ->type_name("PX")
        ->check(CLI::Range(1, 16384));
    play->add_option("--height", o.height, "Height of the view, 720 if not given")
        ->type_name("PX")
        ->check(CLI::Range(1, 16384));
    play->callback([&parsed] { parsed.run = [&](Session& s) { return host::play(s, parsed.play); }; });
}

void addConvert(CLI::App& app, Parsed& parsed)
{
    auto& o = parsed.convert;
    auto* convert = app.add_subcommand(
        "convert",
        "Convert files by extension, e.g. drawing.svg picture.png; '*' in OUTPUT stands for each input's name");
    convert->add_option("files", o.inputs, "INPUT... OUTPUT")->required()->expected(2, -1)->type_name("FILE");
    convert->add_option("--scene", o.scene, "Scene of a project, by name or number")->type_name("N");
    convert->add_option("--width", o.width, "Width of a picture")->type_name("PX")->check(CLI::Range(1, 32768));
    convert->add_option("--height", o.height, "Height of a picture")->type_name("PX")->check(CLI::Range(1, 32768));
    convert->add_option("--background", o.background, "Background of a picture, e.g. white or #ffffff")
        ->type_name("COLOUR");
    convert->add_option("--apply", o.effects, "Put an effect on every shape: EFFECT or EFFECT:property=value,...")
        ->take_all()
        ->allow_extra_args(false);
    convert->add_option("--set", o.properties, "Set a property on every item that has it: property=value")
        ->take_all()
        ->allow_extra_args(false);
    convert->callback([&parsed] {
        parsed.convert.output = parsed.convert.inputs.back();
        parsed.convert.inputs.pop_back();
        parsed.run = [&](Session& s) { return host::convert(s, parsed.convert); };
    });
}

void addPlugins(CLI::App& app, Parsed& parsed)
{
    auto* plugins = app.add_subcommand("plugins", "Look at and manage plugins")->require_subcommand(1);
    plugins->add_subcommand("list", "All plugins with their state")->callback([&parsed] { parsed.run = listPlugins; });
    const auto one = [&](const char* name, const char* help, auto action) {
        auto* command = plugins->add_subcommand(name, help);
        command->add_option("id", parsed.plugin, "Plugin id")->required()->type_name("ID");
        command->callback(
            [&parsed, action] { parsed.run = [&parsed, action](Session& s) { return action(s, parsed.plugin); }; });
    };
    one("info", "Everything about one plugin", [](Session& s, const std::string& id) { return pluginInfo(s, id); });
    auto* explain =
        plugins->add_subcommand("explain", "Which plugin provides a tool, effect, item type or file extension");
    explain->add_option("id", parsed.plugin, "Id of the contribution, or .extension")->required()->type_name("ID");
    explain->add_option("--project", parsed.project, "Also plugins this project was saved with")->type_name("PROJECT");
    explain->callback(
        [&parsed] { parsed.run = [&](Session& s) { return explainContribution(s, parsed.plugin, parsed.project); }; });
    auto* trust = plugins->add_subcommand("trust", "Trust the plugins that come with a project");
    trust->add_option("project", parsed.project, "Project folder or .jet file")->required()->type_name("PROJECT");
    trust->add_flag("--revoke", parsed.revoke, "Trust them no longer");
    trust->callback(
        [&parsed] { parsed.run = [&](Session& s) { return trustPlugins(s, parsed.project, !parsed.revoke); }; });
    one("enable", "Switch a plugin on", [](Session& s, const std::string& id) { return enablePlugin(s, id, true); });
    one("disable", "Switch a plugin off", [](Session& s, const std::string& id) { return enablePlugin(s, id, false); });
    addSetCommands(*plugins, parsed.run);
    addPackageCommands(*plugins, parsed.run);
    addNewPluginCommand(*plugins, parsed.run);
    addCheckCommands(*plugins, parsed.run);
}

void addProject(CLI::App& app, Parsed& parsed)
{
    auto* project = app.add_subcommand("project", "Make, check and rewrite projects")->require_subcommand(1);
    const auto one = [&](const char* name, const char* help, int (*action)(Session&, const std::filesystem::path&)) {
        auto* command = project->add_subcommand(name, help);
        command->add_option("project", parsed.project, "Project folder or .jet file")->required()->type_name("PROJECT");
        command->callback(
            [&parsed, action] { parsed.run = [&parsed, action](Session& s) { return action(s, parsed.project); }; });
    };
    one("new", "Make an empty project", newProject);
    one("info", "What a project holds", projectInfo);
    addRecoveryCommands(*project, parsed.run);
    addPackedCommands(*project, parsed.run);
    addProjectCheckCommand(*project, parsed.run);
}

int run(const Parsed& parsed, Session& session)
{
    try {
        return parsed.run(session);
    } catch (const Failure& failure) {
        session.error(failure.error());
    } catch (const std::exception& e) {
        session.error(Error(e.what()));
    } catch (...) {
        session.error(Error("an unknown exception"));
    }
    return kFailed;
}

std::vector<std::string> commandsOf(const CLI::App& app)
{
    std::vector<std::string> commands;
    for (const CLI::App* command : app.get_subcommands({})) commands.push_back(command->get_name());
    return commands;
}

/// "jet plugins lits": the word falls through to the editor's argument, and what is missing is not the mistake.
std::optional<int> mistypedCommand(const CLI::App& app, const std::filesystem::path& word)
{
    if (word.empty()) return std::nullopt;
    for (const CLI::App* group : app.get_subcommands()) {
        if (commandsOf(*group).empty() || !group->get_subcommands().empty()) continue;
        const std::string nearest = didYouMean(word.string(), commandsOf(*group));
        std::fprintf(stderr, "error: '%s' is no command of 'jet %s'%s 'jet %s --help' lists them\n", word.c_str(),
                     group->get_name().c_str(), nearest.empty() ? ";" : nearest.c_str(), group->get_name().c_str());
        return kUsage;
    }
    return std::nullopt;
}

/// A word that is no command is the project to edit, if there is one of that name. What looks like a slip is one.
std::optional<int> editorProject(const CLI::App& app, const std::filesystem::path& project)
{
    std::error_code ignored;
    if (project.empty() || std::filesystem::exists(project, ignored)) return std::nullopt;
    const std::string nearest = nearestWord(project.string(), commandsOf(app));
    const std::string hint = nearest.empty() ? "'jet project new DIR' makes one, and 'jet --help' lists the commands"
                                             : "did you mean the command '" + nearest + "'?";
    std::fprintf(stderr, "%s: error: there is no such project; %s\n", project.c_str(), hint.c_str());
    return nearest.empty() ? kFailed : kUsage;
}

}  // namespace

std::optional<int> runCommandLine(int argc, char** argv, GlobalOptions& global, std::filesystem::path& project)
{
    CLI::App app("JET, a plugin-based editor for 2D physics games", "jet");
    app.set_version_flag("--version", "jet " JET_SDK_VERSION);
    app.fallthrough();
    addGlobal(app, global);
    Parsed parsed;
    addPlay(app, parsed);
    addConvert(app, parsed);
    addPlugins(app, parsed);
    addProject(app, parsed);
    app.add_option("project", project, "Project to open in the editor")->type_name("PROJECT");
    app.add_option("--watch", global.watch, "In the editor: folder of further plugins, reloaded when they are rebuilt")
        ->type_name("DIR")
        ->take_all()
        ->allow_extra_args(false);
    refuseEmptyValues(app);
    app.failure_message([](const CLI::App* command, const CLI::Error& problem) {
        return "error: " + CLI::FailureMessage::simple(command, problem);
    });
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& problem) {
        if (const auto told = mistypedCommand(app, project)) return *told;
        const bool anyCommand = !app.get_subcommands().empty();
        if (problem.get_exit_code() != 0 && !anyCommand && editorProject(app, project)) return kUsage;
        return app.exit(problem) == 0 ? kOk : kUsage;
    }
    global.pluginPath.insert(global.pluginPath.end(), global.watch.begin(), global.watch.end());
    if (!parsed.run) return editorProject(app, project);
    if (!global.watch.empty()) {
        std::fprintf(stderr, "error: --watch is for the editor; leave it out, or use --plugin-path\n");
        return kUsage;
    }
    // A word too many falls through to the editor's argument.
    if (!project.empty()) {
        std::fprintf(stderr, "error: '%s' is one argument too many; 'jet --help' shows how to call each command\n",
                     project.c_str());
        return kUsage;
    }
    Session session(global);
    session.printCrashes();
    const int code = run(parsed, session);
    return session.tellProblems() ? std::max<int>(code, kFailed) : code;
}

}  // namespace jet::host
