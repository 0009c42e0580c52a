#include "project_check_command.hpp"

#include "commands.hpp"
#include "recovery_commands.hpp"

#include "host/projects/project_archive.hpp"
#include "host/projects/project_check.hpp"

#include <jet/project_lock.hpp>
#include <jet/project_tree.hpp>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace jet::host {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

struct ProjectCheckOptions {
    fs::path project;
    bool repair = false, force = false;
};

void print(const Json& json) { std::printf("%s\n", json.dump(2, ' ', false, Json::error_handler_t::replace).c_str()); }

Json placed(const Session& session, const std::string& message, const Location& where)
{
    return {{"message", session.named(message)},
            {"file", session.named(where.file)},
            {"line", where.line},
            {"column", where.column}};
}

int fail(Session& session, const Error& error)
{
    session.error(error);
    if (session.options().json)
        print({{"ok", false}, {"errors", Json::array({placed(session, error.message, error.where)})}});
    return kFailed;
}

fs::path schemaFolder()
{
    const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "share/jet/schemas";
    std::error_code ignored;
    return fs::exists(folder, ignored) ? folder : fs::path();
}

bool isError(const Finding& finding) { return finding.weight == Finding::Weight::Error; }

void tell(Session& session, const Finding& finding)
{
    std::string text = finding.problem;
    if (finding.repaired) {
        text += "; repaired: " + finding.repair;
    } else if (!finding.repair.empty()) {
        text += "; with --repair " + finding.repair;
    }
    if (isError(finding) && !finding.repaired) {
        session.error(Error(text, finding.where));
    } else {
        session.warning(text, finding.where);
    }
}

/// What the reader remarked, but for what a finding tells already.
std::vector<FormatNote> notesOf(const CheckReport& report)
{
    if (!report.project) return {};
    std::vector<FormatNote> notes = report.project->notes();
    std::erase_if(notes, [&](const FormatNote& note) {
        return std::ranges::any_of(report.findings, [&](const Finding& finding) {
            return finding.where.file == note.where.file && finding.where.line == note.where.line &&
                   note.message.starts_with(finding.problem);
        });
    });
    return notes;
}

Json jsonOf(const Session& session, const CheckReport& report, std::size_t unsaved,
            const std::vector<PluginDifference>& differences)
{
    Json plugins = Json::array();
    for (const PluginDifference& one : differences)
        plugins.push_back({{"plugin", one.id},
                           {"wanted", one.wanted},
                           {"here", one.here},
                           {"uses", one.uses},
                           {"reason", one.reason},
                           {"remedy", one.remedy}});
    Json notes = Json::array(), problems = Json::array(), errors = Json::array(), written = Json::array();
    for (const FormatNote& note : notesOf(report)) notes.push_back(placed(session, note.message, note.where));
    for (const Finding& finding : report.findings) {
        Json problem = placed(session, finding.problem, finding.where);
        problem["weight"] = isError(finding) ? "error" : "warning";
        problem["repair"] = finding.repair;
        problem["repaired"] = finding.repaired;
        problems.push_back(std::move(problem));
        if (isError(finding) && !finding.repaired) errors.push_back(placed(session, finding.problem, finding.where));
    }
    for (const fs::path& file : report.written) written.push_back(file.string());
    const RemovedFiles removed = removedFiles(report.file.parent_path());
    return {{"ok", report.isFine()},     {"notes", notes},
            {"unsavedChanges", unsaved}, {"errors", errors},
            {"problems", problems},      {"written", written},
            {"plugins", plugins},        {"removedFiles", {{"count", removed.files.size()}, {"bytes", removed.bytes}}}};
}

void tellRemoved(const CheckReport& report)
{
    const RemovedFiles removed = removedFiles(report.file.parent_path());
    if (removed.files.empty()) return;
    std::printf("%zu removed files, %.1f kB, are kept in .jet-removed until somebody empties it\n",
                removed.files.size(), static_cast<double>(removed.bytes) / 1e3);
}

void printSummary(const Session& session, const CheckReport& report)
{
    const std::string file = session.named(report.file.string());
    const auto repaired = std::ranges::count_if(report.findings, &Finding::repaired);
    if (repaired > 0) std::printf("%s: %td repaired; what was there is the newest backup\n", file.c_str(), repaired);
    if (report.isFine()) {
        const auto warnings = std::ranges::count_if(report.findings, [](const Finding& f) { return !f.repaired; });
        std::size_t items = 0;
        for (const Scene* scene : report.project->scenes()) items += scene->items().itemCount();
        std::printf("%s: fine: %zu scenes, %zu items, %zu warnings\n", file.c_str(), report.project->scenes().size(),
                    items, notesOf(report).size() + static_cast<std::size_t>(warnings));
        return;
    }
    const auto left =
        std::ranges::count_if(report.findings, [](const Finding& f) { return isError(f) && !f.repaired; });
    const auto mendable = std::ranges::count_if(
        report.findings, [](const Finding& f) { return isError(f) && !f.repaired && !f.repair.empty(); });
    std::printf("%s: %td errors, of which --repair mends %td\n", file.c_str(), left, mendable);
}

/// With --frozen nothing is written before the plugins are compared.
void compareBeforeRepair(Session& session, const fs::path& project)
{
    const auto report = checkProjectFiles(project, session.events(), session.plugins(), {false, schemaFolder()});
    if (!report) throw Failure(report.error());
    if (!report->project)
        throw Failure(Error("which plugins this project records cannot be read before it is repaired; repair it "
                            "without --frozen",
                            Location{report->file.string(), 0, 0}));
    session.comparePlugins(*report->project);
}

int check(Session& session, const ProjectCheckOptions& o)
try {
    if (o.repair && isPackedProject(o.project))
        return fail(session, Error("a packed project is not repaired in place; unpack it with 'jet project unpack'",
                                   Location{o.project.string(), 0, 0}));
    session.useProjectPlugins(o.project);
    const fs::path project = session.readable(o.project);
    ProjectLock lock;
    if (const auto file = findProjectFile(project); o.repair && file) {
        auto taken = ProjectLock::take(*file);
        if (!taken && !o.force) return fail(session, taken.error());
        if (taken) lock = std::move(*taken);
    }
    if (o.repair && session.options().frozen) compareBeforeRepair(session, project);
    const auto report = checkProjectFiles(project, session.events(), session.plugins(), {o.repair, schemaFolder()});
    if (!report) return fail(session, report.error());
    for (const Finding& finding : report->findings) tell(session, finding);
    for (const FormatNote& note : notesOf(*report)) session.warning(note.message, note.where);
    std::vector<PluginDifference> differences;
    if (report->project) differences = session.comparePlugins(*report->project);
    const std::size_t unsaved = tellUnsavedChanges(session, report->file);
    if (session.options().json) {
        print(jsonOf(session, *report, unsaved, differences));
    } else {
        printSummary(session, *report);
        tellRemoved(*report);
    }
    return report->isFine() ? kOk : kFailed;
} catch (const Failure& failure) {
    return fail(session, failure.error());
}

}  // namespace

void addProjectCheckCommand(CLI::App& project, std::function<int(Session&)>& run)
{
    const auto options = std::make_shared<ProjectCheckOptions>();
    auto* command = project.add_subcommand("check", "Tell everything that is wrong with a project");
    command->add_option("project", options->project, "Project folder, .jet or .jetz file")
        ->required()
        ->type_name("PROJECT");
    command->add_flag("--repair", options->repair, "Mend what can be mended; the original becomes a backup");
    command->add_flag("--force", options->force, "Repair although another editor has it open");
    command->callback([&run, options] { run = [options](Session& s) { return check(s, *options); }; });
}

}  // namespace jet::host
