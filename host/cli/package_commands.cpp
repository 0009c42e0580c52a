#include "package_commands.hpp"

#include "host/packages/repository.hpp"
#include "host/packages/settings.hpp"
#include "host/packages/sha256.hpp"

#include <jet/format.hpp>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace jet::host {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

struct PackageOptions {
    fs::path folder, output;
    std::string plugin, from, word;
    bool force = false, purge = false;
};

void print(const Json& json) { std::printf("%s\n", json.dump(2, ' ', false, Json::error_handler_t::replace).c_str()); }

int fail(Session& session, const Error& error)
{
    session.error(error);
    if (session.options().json) print({{"ok", false}, {"error", error.message}, {"file", error.where.file}});
    return kFailed;
}

/// All that is installed, whatever this command's own options leave out of a run.
PluginManager everything(Session& session)
{
    PluginOptions options;
    options.builtIn = builtInPluginFolder();
    options.searchPath = session.options().pluginPath;
    if (const fs::path user = userPluginFolder(); !user.empty()) options.searchPath.push_back(user);
    options.searchPath.push_back(options.builtIn);
    return PluginManager(std::move(options));
}

InstallOptions installOptions(Session& session, const PackageOptions& o)
{
    PluginManager manager = everything(session);
    manager.scan();
    InstallOptions options;
    options.folder = userPluginFolder();
    options.installed = installedPlugins(manager);
    options.force = o.force;
    return options;
}

int pack(Session& session, const PackageOptions& o)
{
    const auto packed = packFolder(o.folder);
    if (!packed) return fail(session, packed.error());
    fs::path output = o.output;
    std::error_code ignored;
    if (output.empty() || fs::is_directory(output, ignored)) output /= packageFileName(packed->manifest);
    if (const auto written = writeFileAtomically(output, packed->bytes); !written)
        return fail(session, written.error());
    if (session.options().json) {
        print({{"ok", true},
               {"package", output.string()},
               {"id", packed->manifest.id},
               {"version", packed->manifest.version.text()},
               {"files", packed->files},
               {"size", packed->bytes.size()},
               {"sha256", sha256(packed->bytes)}});
        return kOk;
    }
    std::printf("packed %s %s: %s (%zu files, %zu bytes)\n", packed->manifest.id.c_str(),
                packed->manifest.version.text().c_str(), output.c_str(), packed->files, packed->bytes.size());
    return kOk;
}

int report(Session& session, const std::vector<InstallOutcome>& outcomes)
{
    Json list = Json::array();
    const auto disabled = readDisabledPlugins();
    for (const InstallOutcome& one : outcomes) {
        std::vector<std::string> notes = one.notes;
        if (disabled.contains(one.id))
            notes.push_back("it is switched off; 'jet plugins enable " + one.id + "' switches it on");
        Json entry{{"id", one.id}, {"version", one.version.text()}, {"folder", one.folder.string()}, {"notes", notes}};
        if (one.before) entry["before"] = one.before->text();
        list.push_back(std::move(entry));
        if (session.options().json) continue;
        const std::string before = one.before ? ", instead of " + one.before->text() : "";
        std::printf("installed %s %s in %s%s\n", one.id.c_str(), one.version.text().c_str(), one.folder.c_str(),
                    before.c_str());
        for (const std::string& note : notes) session.warning(one.id + ": " + note);
    }
    if (session.options().json) print({{"ok", true}, {"installed", list}});
    return kOk;
}

Result<Repository> openRepository(const std::string& from)
{
    const auto source = Source::parse(from);
    if (!source) return source.error();
    return Repository::open(*source);
}

int install(Session& session, const PackageOptions& o)
{
    if (!o.from.empty()) {
        const auto repository = openRepository(o.from);
        if (!repository) return fail(session, repository.error());
        const auto done = installFrom(*repository, o.plugin, installOptions(session, o));
        return done ? report(session, *done) : fail(session, done.error());
    }
    std::error_code ignored;
    const fs::path file = o.plugin;
    if (!fs::exists(file, ignored) && extensionOf(file) != kPackageExtension) {
        session.error(Error("'" + o.plugin +
                            "' is no package file; to install a plugin by its id, say from where: "
                            "--from URL-or-DIR"));
        return kUsage;
    }
    const auto done = installPackage(file, installOptions(session, o));
    return done ? report(session, {*done}) : fail(session, done.error());
}

int remove(Session& session, const PackageOptions& o)
{
    PluginManager manager = everything(session);
    manager.scan();
    Manifest manifest;
    manifest.id = o.plugin;
    if (const Plugin* plugin = manager.plugin(o.plugin)) manifest = plugin->manifest;
    const auto removed = removePlugin(o.plugin, {userPluginFolder(), installedPlugins(manager), o.force});
    if (!removed) return fail(session, removed.error());
    if (o.purge)
        if (const auto dropped = dropSettings(manifest); !dropped) return fail(session, dropped.error());
    if (session.options().json) {
        print({{"ok", true}, {"removed", o.plugin}, {"folder", removed->string()}, {"purged", o.purge}});
        return kOk;
    }
    std::printf("removed %s from %s; its settings are %s\n", o.plugin.c_str(), removed->c_str(),
                o.purge ? "dropped" : "kept (--purge drops them)");
    return kOk;
}

Json jsonOf(const Repository& repository, const IndexEntry& entry)
{
    const auto fits = entry.fits();
    Json json{{"id", entry.id},
              {"name", entry.name},
              {"version", entry.version.text()},
              {"description", entry.description},
              {"license", entry.license},
              {"contributes", entry.contributions},
              {"requires", Json::array()},
              {"package", repository.address(entry)},
              {"size", entry.size},
              {"sha256", entry.sha256},
              {"fits", static_cast<bool>(fits)}};
    if (!fits) json["reason"] = fits.error().message;
    for (const Dependency& need : entry.needs) json["requires"].push_back(need.id);
    return json;
}

int search(Session& session, const PackageOptions& o)
{
    const auto repository = openRepository(o.from);
    if (!repository) return fail(session, repository.error());
    const auto found = repository->search(o.word);
    if (session.options().json) {
        Json list = Json::array();
        for (const IndexEntry* entry : found) list.push_back(jsonOf(*repository, *entry));
        print({{"ok", true}, {"plugins", list}});
        return kOk;
    }
    std::size_t width = 0;
    for (const IndexEntry* entry : found) width = std::max(width, entry->id.size());
    for (const IndexEntry* entry : found) {
        const auto fits = entry->fits();
        std::printf("%-*s  %-8s %s%s\n", static_cast<int>(width), entry->id.c_str(), entry->version.text().c_str(),
                    entry->description.empty() ? entry->name.c_str() : entry->description.c_str(),
                    fits ? "" : (" (does not fit: " + fits.error().message + ")").c_str());
    }
    if (found.empty())
        std::fprintf(stderr, "nothing found: the repository has %zu packages\n", repository->index().entries.size());
    return kOk;
}

int index(Session& session, const PackageOptions& o)
{
    std::vector<Error> problems;
    const auto made = indexFolder(o.folder, problems);
    if (!made) return fail(session, made.error());
    for (const Error& problem : problems) session.error(problem);
    const fs::path file = o.folder / "index.json";
    if (const auto written = writeFileAtomically(file, made->text()); !written) return fail(session, written.error());
    if (session.options().json) {
        Json list = Json::array();
        for (const Error& problem : problems) list.push_back(problem.text());
        print({{"ok", problems.empty()},
               {"index", file.string()},
               {"packages", made->entries.size()},
               {"problems", list}});
    } else {
        std::printf("wrote %s: %zu packages\n", file.c_str(), made->entries.size());
    }
    return problems.empty() ? kOk : kFailed;
}

int tryFolder(Session& session, const PackageOptions& o)
{
    const auto loaded = tryLoad(o.folder);
    if (!loaded) session.error(loaded.error());
    return loaded ? kOk : kFailed;
}

}  // namespace

void addPackageCommands(CLI::App& plugins, std::function<int(Session&)>& run)
{
    const auto options = std::make_shared<PackageOptions>();
    const auto command = [&](const char* name, const char* help, int (*action)(Session&, const PackageOptions&)) {
        auto* added = plugins.add_subcommand(name, help);
        added->callback(
            [&run, options, action] { run = [options, action](Session& s) { return action(s, *options); }; });
        return added;
    };
    const char* const fromHelp = "Repository: a folder with an index.json, or its address (file, http, https)";

    auto* packing = command("pack", "Make a package (.jetplugin) of a built plugin folder", pack);
    packing->add_option("folder", options->folder, "Folder of a built plugin")->required()->type_name("DIR");
    packing->add_option("target", options->output, "File or folder to write to; ID-VERSION.jetplugin here if not given")
        ->type_name("OUTPUT");

    auto* installing =
        command("install", "Install or update a plugin from a package, or by its id from a repository", install);
    installing->add_option("plugin", options->plugin, "A .jetplugin file, or with --from a plugin id")
        ->required()
        ->type_name("FILE|ID");
    installing->add_option("--from", options->from, fromHelp)->type_name("URL-or-DIR");
    installing->add_flag("--force", options->force, "Take an older version, or one that requires what is missing");

    auto* removing = command("remove", "Remove a plugin that was installed; its settings are kept", remove);
    removing->add_option("id", options->plugin, "Plugin id")->required()->type_name("ID");
    removing->add_flag("--force", options->force, "Although other plugins require it");
    removing->add_flag("--purge", options->purge, "Drop its settings, too");

    auto* searching = command("search", "Find plugins in a repository", search);
    searching->add_option("word", options->word, "Part of an id, name, description or contribution; all if not given")
        ->type_name("WORD");
    searching->add_option("--from", options->from, fromHelp)->required()->type_name("URL-or-DIR");

    auto* indexing =
        command("index", "Write the index.json of a folder of packages, which makes it a repository", index);
    indexing->add_option("folder", options->folder, "Folder of packages")->required()->type_name("DIR");

    // For installers, which try a library in a process of its own.
    command("try-load", "", tryFolder)->group("")->add_option("folder", options->folder)->required();
}

}  // namespace jet::host
