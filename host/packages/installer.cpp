#include "installer.hpp"

#include "host/archive/disk.hpp"
#include "host/plugins/guard.hpp"
#include "host/plugins/plugin_library.hpp"
#include "host/process/child_process.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>

namespace jet::host {

namespace fs = std::filesystem;

namespace {

constexpr std::chrono::seconds kTrialTime{30};
constexpr std::size_t kTrialMemory = std::size_t{2} << 30;

Error at(const fs::path& file, const std::string& message) { return Error(message, Location{file.string(), 0, 0}); }

std::string nameAndVersion(const Manifest& manifest) { return manifest.id + " " + manifest.version.text(); }

bool isIn(const fs::path& plugin, const fs::path& folder)
{
    std::error_code ignored;
    return fs::weakly_canonical(fs::absolute(plugin, ignored).parent_path(), ignored) ==
           fs::weakly_canonical(folder, ignored);
}

std::string lastLine(std::string text)
{
    while (!text.empty() && text.back() == '\n') text.pop_back();
    const std::size_t line = text.rfind('\n');
    if (line != std::string::npos) text.erase(0, line + 1);
    if (const auto mark = text.find("error: "); mark != std::string::npos) text.erase(0, mark + 7);
    return text;
}

}  // namespace

std::vector<InstalledPlugin> installedPlugins(const PluginManager& manager)
{
    std::vector<InstalledPlugin> list;
    for (const Plugin* plugin : manager.plugins())
        list.push_back({plugin->manifest.id, plugin->manifest.version, plugin->folder, plugin->manifest.requires_,
                        !plugin->manifest.library.empty()});
    return list;
}

Result<std::unique_ptr<Installer>> Installer::open(InstallOptions options)
{
    if (options.folder.empty())
        return Error("there is no folder for plugins: neither XDG_DATA_HOME nor HOME is set; set one of them");
    if (options.program.empty()) options.program = ownProgram();
    std::error_code problem;
    const fs::path staging = options.folder / ".staging";
    fs::create_directories(staging, problem);
    if (problem) return diskError(staging, "the folder cannot be made", problem.value());
    auto lock = FolderLock::take(staging / "lock");
    if (!lock) return lock.error();
    std::unique_ptr<Installer> installer(new Installer(std::move(options), std::move(*lock)));
    installer->clean();  // what an installer left that did not come to its end
    return installer;
}

Installer::Installer(InstallOptions options, std::unique_ptr<FolderLock> lock)
    : options_(std::move(options)), lock_(std::move(lock))
{
}

Installer::~Installer() { clean(); }

void Installer::clean()
{
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(staging(), ignored))
        if (entry.path().filename() != "lock") fs::remove_all(entry.path(), ignored);
}

Result<void> Installer::stage(std::string_view bytes, const fs::path& package)
{
    Staged staged;
    staged.package = package;
    staged.folder = staging() / std::to_string(++count_);
    std::error_code problem;
    if (!fs::create_directory(staged.folder, problem))
        return diskError(staged.folder, "the folder cannot be made", problem.value());
    if (const auto unpacked = unpackZip(bytes, staged.folder, package, options_.limits); !unpacked) return unpacked;
    if (!fs::exists(staged.folder / "plugin.json", problem))
        return at(package, "this package has no plugin.json at its top; make it with 'jet plugins pack'");
    auto text = readFile(staged.folder / "plugin.json");
    if (!text) return text.error();
    auto manifest = Manifest::parse(*text, package / "plugin.json");
    if (!manifest) return manifest.error();
    staged.manifest = std::move(*manifest);
    for (const Staged& other : staged_)
        if (other.manifest.id == staged.manifest.id)
            return at(package, "it is the same plugin as " + other.package.string() + "; give one of them");
    const auto refuse = [&](const Error& why) {
        return at(package, "the plugin " + nameAndVersion(staged.manifest) + " cannot be installed: " + why.message);
    };
    if (const auto fits = checkBuild(staged.manifest); !fits) return refuse(fits.error());
    if (const auto complete = checkContents(staged.manifest, staged.folder); !complete) return refuse(complete.error());
    if (const auto found = findTarget(staged); !found) return refuse(found.error());
    if (const auto loads = checkLibrary(staged); !loads) return refuse(loads.error());
    staged_.push_back(std::move(staged));
    return {};
}

Result<void> Installer::findTarget(Staged& staged) const
{
    staged.target = options_.folder / staged.manifest.id;
    for (const InstalledPlugin& other : options_.installed) {
        if (other.id != staged.manifest.id || !isIn(other.folder, options_.folder)) continue;
        staged.target = other.folder;
        if (other.works) staged.before = other.version;
        break;
    }
    std::error_code ignored;
    staged.replaces = fs::exists(fs::symlink_status(staged.target, ignored));
    if (staged.before && *staged.before > staged.manifest.version && !options_.force)
        return Error("the newer version " + staged.before->text() + " is installed; --force takes the older one");
    return {};
}

Result<void> Installer::checkLibrary(const Staged& staged) const
{
    ChildOptions child;
    child.limits.time = kTrialTime;
    child.limits.memory = kTrialMemory;
    child.environment = {{"QT_QPA_PLATFORM", "offscreen"}};
    const auto tried = runChild({options_.program.string(), "plugins", "try-load", staged.folder.string()}, child);
    if (!tried) return tried.error();
    if (tried->fine()) return {};
    if (!tried->endedByItself())
        return Error("loading its library fails: " + tried->reason(child.limits) + "; tell its author");
    return Error(lastLine(tried->err));
}

const InstalledPlugin* Installer::installed(const std::string& id) const
{
    const InstalledPlugin* best = nullptr;
    for (const InstalledPlugin& one : options_.installed)
        if (one.id == id && one.works && (!best || one.version > best->version)) best = &one;
    return best;
}

Result<void> Installer::checkDependencies(const Staged& staged) const
{
    std::string missing;
    for (const Dependency& need : staged.manifest.requires_) {
        const auto admits = [&](const Version& version) { return need.admits(version); };
        const auto together = std::find_if(staged_.begin(), staged_.end(),
                                           [&](const Staged& other) { return other.manifest.id == need.id; });
        const InstalledPlugin* there = installed(need.id);
        std::string problem;
        if (together != staged_.end()) {
            if (!admits(together->manifest.version))
                problem = "version " + together->manifest.version.text() + " does not do";
        } else if (!there) {
            problem = "is not installed";
        } else if (!admits(there->version)) {
            problem = "version " + there->version.text() + " is installed and does not do";
        }
        if (problem.empty()) continue;
        missing += (missing.empty() ? "" : "; ") + need.text() + " " + problem;
    }
    if (missing.empty()) return {};
    return at(staged.package,
              "the plugin " + nameAndVersion(staged.manifest) + " requires " + missing +
                  "; install that first, or all at once with --from REPOSITORY (--force installs regardless)");
}

Result<void> Installer::putInPlace(Staged& staged)
{
    if (staged.replaces) {
        if (const auto done = exchange(staged.folder, staged.target); !done) return done;
    } else if (::rename(staged.folder.c_str(), staged.target.c_str()) != 0) {
        return diskError(staged.target, "cannot be put in place", errno);
    }
    staged.inPlace = true;
    return {};
}

void Installer::takeBack()
{
    for (Staged& staged : staged_) {
        if (!staged.inPlace) continue;
        if (staged.replaces)
            (void)exchange(staged.folder, staged.target);
        else
            (void)::rename(staged.target.c_str(), staged.folder.c_str());
        staged.inPlace = false;
    }
}

InstallOutcome Installer::outcomeOf(const Staged& staged) const
{
    InstallOutcome outcome{staged.manifest.id, staged.manifest.name, staged.manifest.version,
                           staged.target,      staged.before,        {}};
    for (const InstalledPlugin& other : options_.installed) {
        const bool elsewhere = other.id == staged.manifest.id && !isIn(other.folder, options_.folder);
        if (elsewhere && other.works && other.version > staged.manifest.version)
            outcome.notes.push_back("version " + other.version.text() + " in " + other.folder.string() +
                                    " is newer and is used instead");
    }
    return outcome;
}

Result<std::vector<InstallOutcome>> Installer::commit()
{
    if (!options_.force)
        for (const Staged& staged : staged_)
            if (const auto there = checkDependencies(staged); !there) return there.error();
    for (Staged& staged : staged_) {
        if (const auto placed = putInPlace(staged); !placed) {
            takeBack();
            return placed.error();
        }
    }
    if (const auto synced = syncFolder(options_.folder); !synced) {
        takeBack();
        return synced.error();
    }
    std::vector<InstallOutcome> outcomes;
    for (const Staged& staged : staged_) outcomes.push_back(outcomeOf(staged));
    staged_.clear();
    clean();
    return outcomes;
}

Result<InstallOutcome> installPackage(const fs::path& file, InstallOptions options)
{
    const auto bytes = readPackage(file, options.limits);
    if (!bytes) return bytes.error();
    auto installer = Installer::open(std::move(options));
    if (!installer) return installer.error();
    if (const auto staged = (*installer)->stage(*bytes, file); !staged) return staged.error();
    auto done = (*installer)->commit();
    if (!done) return done.error();
    return std::move(done->front());
}

Result<fs::path> removePlugin(const std::string& id, const RemoveOptions& options)
{
    const InstalledPlugin* found = nullptr;
    bool elsewhere = false;
    fs::path place;
    std::string dependents;
    for (const InstalledPlugin& one : options.installed) {
        if (one.id == id && isIn(one.folder, options.folder)) found = &one;
        if (one.id == id && !isIn(one.folder, options.folder)) elsewhere = true, place = one.folder;
        const bool needs =
            std::any_of(one.needs.begin(), one.needs.end(), [&](const Dependency& d) { return d.id == id; });
        if (needs && one.id != id) dependents += (dependents.empty() ? "" : ", ") + one.id;
    }
    if (!found && elsewhere)
        return at(place,
                  "the plugin " + id + " was not installed by you; 'jet plugins disable " + id + "' switches it off");
    if (!found) return Error("there is no plugin '" + id + "'; 'jet plugins list' shows all");
    // Where another copy stays, those who need it still have one.
    if (!dependents.empty() && !elsewhere && !options.force)
        return Error("the plugin " + id + " is required by " + dependents + "; remove these first, or add --force");
    std::error_code problem;
    const fs::path staging = options.folder / ".staging";
    fs::create_directories(staging, problem);
    if (problem) return diskError(staging, "the folder cannot be made", problem.value());
    const auto lock = FolderLock::take(staging / "lock");
    if (!lock) return lock.error();
    // Out of sight in one step; then it may take its time, and what is left of it the next installer clears away.
    const fs::path away = staging / ("removed-" + id), folder = found->folder;
    fs::remove_all(away, problem);
    if (::rename(folder.c_str(), away.c_str()) != 0) return diskError(folder, "cannot be removed", errno);
    if (const auto synced = syncFolder(options.folder); !synced) return synced.error();
    fs::remove_all(away, problem);
    return folder;
}

Result<void> tryLoad(const fs::path& folder)
{
    Plugin plugin;
    auto manifest = Manifest::read(folder / "plugin.json");
    if (!manifest) return manifest.error();
    plugin.folder = folder;
    plugin.manifest = std::move(*manifest);
    if (const auto fits = checkBuild(plugin.manifest); !fits) return fits;
    Registrations registrations;
    Guard guard;
    CallAccount account(plugin, guard, plugin.manifest.id + " " + plugin.manifest.version.text());
    const auto opened = PluginLibrary::open(plugin.folder, plugin.manifest, account, {}, registrations);
    if (!opened) return opened.error();
    return checkRegistrations(plugin.manifest, registrations);
}

}  // namespace jet::host
