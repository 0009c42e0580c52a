#include "recovery_commands.hpp"

#include "project_access.hpp"

#include <jet/journal.hpp>
#include <jet/project_lock.hpp>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <ctime>

namespace jet::host {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

struct RecoveryOptions {
    fs::path project, to;
    std::string name;
    bool force = false, discard = false;
};

std::string dump(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace); }

std::string timeText(std::chrono::system_clock::time_point time)
{
    const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
    std::tm utc{};
    ::gmtime_r(&seconds, &utc);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S UTC", &utc);
    return text;
}

int fail(Session& session, const Error& error)
{
    session.error(error);
    if (session.options().json) std::printf("%s\n", dump({{"ok", false}, {"error", error.message}}).c_str());
    return kFailed;
}

/// The lock of a project that is about to be written; an Error only without --force.
Result<ProjectLock> lockFor(const fs::path& project, bool force)
{
    const auto file = findProjectFile(project);
    if (!file) return file.error();
    auto lock = ProjectLock::take(*file);
    if (lock || !force) return lock;
    return ProjectLock();
}

int save(Session& session, const RecoveryOptions& o)
{
    const auto lock = lockFor(o.project, o.force);
    if (!lock) return fail(session, lock.error());
    const auto project = openProject(session, o.project);
    if (!project) return kFailed;
    const auto saved = project->save(o.force ? Overwrite::Allow : Overwrite::Refuse);
    for (const std::string& note : project->saveNotes()) session.warning(note);
    return saved ? kOk : fail(session, saved.error());
}

// --- recover

/// Journals of the project, or of all when none is named; those of living editors are left out.
std::vector<JournalInfo> journalsOf(const fs::path& project)
{
    std::vector<JournalInfo> found = findJournals();
    std::error_code ignored;
    const fs::path wanted = project.empty()            ? fs::path()
                            : findProjectFile(project) ? *findProjectFile(project)
                                                       : project;
    std::erase_if(found, [&](const JournalInfo& info) {
        if (info.inUse) return true;
        if (wanted.empty() || info.file == wanted) return false;
        return fs::weakly_canonical(info.project, ignored) !=
               fs::weakly_canonical(fs::absolute(wanted, ignored), ignored);
    });
    return found;
}

Json journalJson(const JournalInfo& info)
{
    return {{"journal", info.file.string()},           {"name", info.name},
            {"project", info.project.string()},        {"changes", info.changes},
            {"lastChange", timeText(info.lastChange)}, {"torn", info.torn}};
}

int listJournals(Session& session, const std::vector<JournalInfo>& journals)
{
    if (session.options().json) {
        Json list = Json::array();
        for (const JournalInfo& info : journals) list.push_back(journalJson(info));
        std::printf("%s\n", dump(list).c_str());
        return kOk;
    }
    if (journals.empty()) std::printf("there are no unsaved changes to recover\n");
    for (const JournalInfo& info : journals)
        std::printf("%s: %zu changes, the last at %s\n    %s\n    %s\n", info.name.c_str(), info.changes,
                    timeText(info.lastChange).c_str(),
                    info.project.empty() ? "never saved: recover it with --to DIR" : info.project.c_str(),
                    info.file.c_str());
    return kOk;
}

int recoverOne(Session& session, const JournalInfo& info, const RecoveryOptions& o)
{
    Result<Recovery> recovery = recoverProject(info.file, session.events(), session.plugins());
    if (!recovery) return fail(session, recovery.error());
    for (const FormatNote& note : recovery->project->notes()) session.warning(note.message, note.where);
    for (const std::string& note : recovery->notes) session.warning(note);
    Project& project = *recovery->project;
    if (o.to.empty() && project.file().empty())
        return fail(session, Error("this project has no file to go to; name a folder with --to DIR",
                                   Location{info.file.string(), 0, 0}));
    ProjectLock lock;
    if (o.to.empty()) {
        auto taken = lockFor(project.file(), o.force);
        if (!taken) return fail(session, taken.error());
        lock = std::move(*taken);
    }
    const auto saved =
        o.to.empty() ? project.save(o.force ? Overwrite::Allow : Overwrite::Refuse) : project.saveAs(o.to);
    for (const std::string& note : project.saveNotes()) session.warning(note);
    if (!saved) return fail(session, saved.error());
    if (const auto removed = Journal::remove(info.file); !removed) return fail(session, removed.error());
    if (session.options().json) {
        std::printf("%s\n", dump({{"ok", true},
                                  {"changes", recovery->changes},
                                  {"file", project.file().string()},
                                  {"hash", hashText(project.hash())}})
                                .c_str());
    } else {
        std::printf("recovered %zu changes into %s\n", recovery->changes, project.file().c_str());
    }
    return kOk;
}

int recover(Session& session, const RecoveryOptions& o)
{
    std::vector<JournalInfo> journals = journalsOf(o.project);
    if (o.project.empty()) return listJournals(session, journals);
    if (journals.empty()) {
        if (session.options().json)
            std::printf("%s\n", dump({{"ok", true}, {"changes", 0}}).c_str());
        else
            std::printf("there are no unsaved changes of %s\n", o.project.c_str());
        return kOk;
    }
    if (o.discard) {
        for (const JournalInfo& info : journals)
            if (const auto removed = Journal::remove(info.file); !removed) return fail(session, removed.error());
        return kOk;
    }
    if (journals.size() > 1) {
        listJournals(session, journals);
        return fail(session,
                    Error("there are several journals of this project; name the file of one of them instead of "
                          "the project, the latest is the first",
                          Location{o.project.string(), 0, 0}));
    }
    return recoverOne(session, journals.front(), o);
}

// --- backups

int listBackups(Session& session, const RecoveryOptions& o)
{
    const auto backups = findBackups(o.project);
    if (session.options().json) {
        Json list = Json::array();
        for (const Backup& backup : backups)
            list.push_back({{"name", backup.name}, {"folder", backup.folder.string()}});
        std::printf("%s\n", dump(list).c_str());
        return kOk;
    }
    if (backups.empty()) std::printf("there are no backups of %s\n", o.project.c_str());
    for (const Backup& backup : backups) std::printf("%s  %s\n", backup.name.c_str(), backup.folder.c_str());
    return kOk;
}

int restore(Session& session, const RecoveryOptions& o)
{
    const auto file = findProjectFile(o.project);
    const fs::path target = file ? *file : o.project / "project.jet";  // project.jet may be what is missing
    const auto backups = findBackups(target);
    if (backups.empty())
        return fail(session, Error("there are no backups of this project", Location{o.project.string(), 0, 0}));
    auto lock = ProjectLock::take(target);
    if (!lock && !o.force) return fail(session, lock.error());
    const std::string name = o.name.empty() ? backups.front().name : o.name;
    if (const auto restored = restoreBackup(target, name); !restored) return fail(session, restored.error());
    std::printf("restored the state of %s; what was there is the newest backup now\n", name.c_str());
    return kOk;
}

}  // namespace

std::size_t tellUnsavedChanges(Session& session, const fs::path& projectFile)
{
    std::size_t changes = 0;
    for (const JournalInfo& info : journalsOf(projectFile)) {
        changes += info.changes;
        session.warning(std::to_string(info.changes) + " changes, the last at " + timeText(info.lastChange) +
                            ", were not saved before JET ended; 'jet project recover' makes them again",
                        Location{projectFile.string(), 0, 0});
    }
    return changes;
}

void addRecoveryCommands(CLI::App& project, std::function<int(Session&)>& run)
{
    const auto options = std::make_shared<RecoveryOptions>();
    const auto command = [&](const char* name, const char* help, int (*action)(Session&, const RecoveryOptions&)) {
        auto* added = project.add_subcommand(name, help);
        added->callback(
            [&run, options, action] { run = [options, action](Session& s) { return action(s, *options); }; });
        return added;
    };
    const auto addProject = [&](CLI::App* to) {
        return to->add_option("project", options->project, "Project folder or .jet file")->type_name("PROJECT");
    };
    const auto addForce = [&](CLI::App* to) {
        to->add_flag("--force", options->force,
                     "Although another editor has it open, and over what another program changed meanwhile");
    };
    auto* saving = command("save", "Open and write back in place", save);
    addProject(saving)->required();
    addForce(saving);
    auto* recovering = command("recover", "Save what was not saved before a crash; without PROJECT, list it", recover);
    addProject(recovering);
    addForce(recovering);
    recovering->add_option("--to", options->to, "Save in this folder instead")->type_name("DIR");
    recovering->add_flag("--discard", options->discard, "Forget the unsaved changes of the project");
    addProject(command("backups", "List the former states that saving kept", listBackups))->required();
    auto* restoring = command("restore", "Put a former state back; the present one becomes a backup", restore);
    addProject(restoring)->required();
    restoring->add_option("backup", options->name, "Its name, as 'backups' lists it; the newest if not given")
        ->type_name("NAME");
    addForce(restoring);
}

}  // namespace jet::host
