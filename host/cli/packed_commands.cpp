#include "packed_commands.hpp"

#include "project_access.hpp"

#include "host/projects/collect.hpp"
#include "host/projects/project_archive.hpp"

#include <jet/format.hpp>
#include <jet/project_lock.hpp>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace jet::host {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

struct PackedOptions {
    fs::path project, output, folder;
    bool force = false;
};

void print(const Json& json) { std::printf("%s\n", json.dump(2, ' ', false, Json::error_handler_t::replace).c_str()); }

int fail(Session& session, const Error& error)
{
    session.error(error);
    if (session.options().json) print({{"ok", false}, {"error", error.message}, {"file", error.where.file}});
    return kFailed;
}

Json textsOf(const std::vector<fs::path>& paths)
{
    Json list = Json::array();
    for (const fs::path& path : paths) list.push_back(path.string());
    return list;
}

// "games/ball/" -> "ball.jetz", beside where the user is
fs::path proposedFile(const Project& project)
{
    std::error_code ignored;
    const bool isMain = project.file().filename() == "project.jet";
    const fs::path named = isMain ? fs::absolute(project.folder(), ignored).lexically_normal() : project.file().stem();
    const std::string name = (named.has_filename() ? named : named.parent_path()).filename().string();
    return (name.empty() ? "project" : name) + "." + std::string(kPackedProjectExtension);
}

int pack(Session& session, const PackedOptions& o)
{
    if (isPackedProject(o.project))
        return fail(session, Error("is packed already", Location{o.project.string(), 0, 0}));
    const auto project = openProject(session, o.project);
    if (!project) return kFailed;
    const fs::path output = o.output.empty() ? proposedFile(*project) : o.output;
    if (extensionOf(output) != kPackedProjectExtension)
        return fail(session,
                    Error("the name of a packed project ends in .jetz; choose one", Location{output.string(), 0, 0}));
    const auto packed = packProject(*project);
    if (!packed) return fail(session, packed.error());
    for (const fs::path& file : packed->outside)
        session.warning(
            "lies outside of the project and is not packed; 'jet project collect' copies it into the project",
            Location{file.string(), 0, 0});
    for (const fs::path& file : packed->missing)
        session.warning("the project refers to this file, which is not there", Location{file.string(), 0, 0});
    if (const auto written = writeFileAtomically(output, packed->bytes); !written)
        return fail(session, written.error());
    if (session.options().json) {
        print({{"ok", true},
               {"file", output.string()},
               {"files", packed->files},
               {"bytes", packed->bytes.size()},
               {"outside", textsOf(packed->outside)},
               {"missing", textsOf(packed->missing)}});
    } else {
        std::printf("packed %zu files into %s (%zu bytes)\n", packed->files, output.c_str(), packed->bytes.size());
    }
    return kOk;
}

int unpack(Session& session, const PackedOptions& o)
{
    const auto project = unpackProject(o.project, o.folder);
    if (!project) return fail(session, project.error());
    if (session.options().json) {
        print({{"ok", true}, {"file", project->string()}});
    } else {
        std::printf("unpacked %s\n", project->c_str());
    }
    return kOk;
}

Json copiesOf(const Collection& collection)
{
    Json copies = Json::array();
    for (const auto& [from, to] : collection.copies) copies.push_back({{"from", from.string()}, {"to", to}});
    return copies;
}

int collect(Session& session, const PackedOptions& o)
{
    const auto file = findProjectFile(o.project);
    if (!file) return fail(session, file.error());
    const auto lock = ProjectLock::take(*file);
    if (!lock && !o.force) return fail(session, lock.error());
    const auto project = openProject(session, *file);
    if (!project) return kFailed;
    const auto collection = collectAssets(*project);
    if (!collection) return fail(session, collection.error());
    const auto saved = project->save(o.force ? Overwrite::Allow : Overwrite::Refuse);
    for (const std::string& note : project->saveNotes()) session.warning(note);
    if (!saved) return fail(session, saved.error());
    const auto remarks = describe(*collection);
    for (const std::string& remark : remarks) session.warning(remark);
    if (session.options().json) {
        print({{"ok", remarks.empty()},
               {"copies", copiesOf(*collection)},
               {"references", collection->references},
               {"problems", remarks}});
    } else {
        for (const auto& [from, to] : collection->copies) std::printf("%s -> %s\n", from.c_str(), to.c_str());
        std::printf("%zu files copied, %zu references rewritten\n", collection->copies.size(), collection->references);
    }
    return remarks.empty() ? kOk : kFailed;
}

}  // namespace

void addPackedCommands(CLI::App& project, std::function<int(Session&)>& run)
{
    const auto options = std::make_shared<PackedOptions>();
    const auto command = [&](const char* name, const char* help, int (*action)(Session&, const PackedOptions&)) {
        auto* added = project.add_subcommand(name, help);
        added->callback(
            [&run, options, action] { run = [options, action](Session& s) { return action(s, *options); }; });
        return added;
    };
    auto* packing = command("pack", "Pack a project into one file, for sending", pack);
    packing->add_option("project", options->project, "Project folder or .jet file")->required()->type_name("PROJECT");
    packing->add_option("-o,--output", options->output, "The file; NAME.jetz here if not given")->type_name("FILE");
    auto* unpacking = command("unpack", "Unpack a packed project into a new folder", unpack);
    unpacking->add_option("file", options->project, "The packed project, *.jetz")->required()->type_name("FILE");
    unpacking->add_option("folder", options->folder, "A folder that is empty or not there yet")
        ->required()
        ->type_name("DIR");
    auto* collecting = command("collect", "Copy the files a project uses from elsewhere into its folder", collect);
    collecting->add_option("project", options->project, "Project folder or .jet file")
        ->required()
        ->type_name("PROJECT");
    collecting->add_flag("--force", options->force,
                         "Although another editor has it open, and over what another program changed meanwhile");
}

}  // namespace jet::host
