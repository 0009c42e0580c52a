#include "session.hpp"

#include "host/plugins/plugin_differences.hpp"
#include "host/plugins/plugin_set_files.hpp"
#include "host/plugins/project_trust.hpp"
#include "host/projects/project_archive.hpp"

#include <cstdio>

namespace jet::host {

namespace fs = std::filesystem;

struct Session::Unpacked {
    fs::path packed;
    UnpackedProject copy;
};

Session::Session(GlobalOptions options) : options_(std::move(options)) {}

Session::~Session()
{
    watchdog_.reset();
    plugins_.reset();
    CrashLedger::ending();
}

void Session::printCrashes()
{
    for (const CrashReport& report : crashes()) {
        if (report.toldBefore) continue;
        warning(report.message + "; '--without " + report.plugin +
                "' goes on without it, '--safe-mode' with the shipped plugins only");
        CrashLedger::told(report);
    }
}

PluginOptions Session::pluginOptions()
{
    PluginOptions options;
    options.builtIn = builtInPluginFolder();
    options.searchPath = options_.pluginPath;
    options.copyLibraries = !options_.watch.empty();
    std::error_code ignored;
    for (const fs::path& folder : options.searchPath)
        if (!fs::is_directory(folder, ignored))
            throw Failure(
                Error("there is no such folder of plugins; check --plugin-path", Location{folder.string(), 0, 0}));
    if (const fs::path user = userPluginFolder(); !user.empty()) options.searchPath.push_back(user);
    options.searchPath.push_back(options.builtIn);
    options.without = {options_.without.begin(), options_.without.end()};
    options.disabled = readDisabledPlugins();
    if (const fs::path config = userConfigFolder(); !config.empty()) options.settings = config / "settings";
    options.safeMode = options_.safeMode;
    options.set = chosenSet();
    return options;
}

std::optional<PluginSet> Session::chosenSet()
{
    const PluginSetFiles files(project_.empty() ? setsOf_ : readable(project_));
    if (!options_.set.empty()) return files.choose(options_.set).orThrow();
    const std::string stored = options_.safeMode ? std::string() : readChosenSet();
    if (stored.empty()) return std::nullopt;
    auto set = files.read(stored);
    if (set) return std::move(*set);
    warning("the plugin set '" + stored + "', which was chosen earlier, is not used, but all plugins: " +
            set.error().text() + "; 'jet plugins sets use' chooses another one");
    return std::nullopt;
}

PluginManager& Session::plugins()
{
    if (plugins_) return *plugins_;
    plugins_ = std::make_unique<PluginManager>(pluginOptions());
    plugins_->setProblemHandler([this](const PluginProblem& problem) {
        const std::lock_guard lock(mutex_);
        problems_.push_back(problem);
    });
    plugins_->setHangHandler([this](const PluginProblem& problem) { warning(problem.message); });
    plugins_->scan();
    static const CrashLedger ledger(CrashLedger::defaultFolder());  // one a process
    watchdog_ = std::make_unique<Watchdog>();
    bringInProject();
    tellOfSet();
    return *plugins_;
}

fs::path Session::readable(const fs::path& project)
{
    if (!isPackedProject(project)) return project;
    for (const auto& known : unpacked_)
        if (known->packed == project) return known->copy.folder();
    unpacked_.push_back(std::make_unique<Unpacked>(Unpacked{project, UnpackedProject::make(project).orThrow()}));
    return unpacked_.back()->copy.folder();
}

void Session::useProjectPlugins(const fs::path& project)
{
    project_ = project;
    if (plugins_)
        bringInProject();
    else
        (void)plugins();
}

void Session::bringInProject()
{
    if (project_.empty()) return;
    if (auto set = PluginSetFiles(readable(project_)).ofProject()) {
        if (!*set) return error(set->error());
        plugins_->setProjectSet(std::move(**set));
    }
    auto found = findProjectPlugins(readable(project_));
    if (!found) return;
    // Trust is in a folder that stays: the copy is another one each time.
    if (isPackedProject(project_))
        return warning("the plugins of a packed project are left out; unpack it with 'jet project unpack' to use them",
                       Location{project_.string(), 0, 0});
    if (options_.safeMode) return warning("the plugins of the project are left out in safe mode");
    if (options_.trust && !found->isTrusted()) {
        trustProject(*found).orThrow();
        found->trust = ProjectPlugins::Trust::Trusted;
    }
    if (!found->isTrusted()) return warning(found->advice());
    plugins_->addFolder(found->folder, PluginOrigin::Project);
}

// --- what should be here

void Session::tellOfSet()
{
    const auto& set = plugins_->options().set;
    if (!set) return;
    for (const Error& remark : set->warnings) warning(remark.message, remark.where);
    if (options_.frozen) return checkFrozen(*plugins_, nullptr).orThrow();
    for (const PluginDifference& difference : setDifferences(*plugins_, *set)) {
        Location where{set->file.string(), 0, 0};
        for (const PluginSet::Entry* entry : set->entries())
            if (entry->plugin.id == difference.id && entry->where.line > 0) where = entry->where;
        const Plugin* plugin = plugins_->plugin(difference.id);
        const bool wrong = !plugin || (!plugin->broken && !set->admits(difference.id, plugin->manifest.version));
        if (wrong) warning(sentenceOf(difference), where);
    }
}

std::vector<PluginDifference> Session::comparePlugins(const Project& project)
{
    if (options_.frozen) checkFrozen(plugins(), &project).orThrow();
    auto differences = projectDifferences(plugins(), project);
    for (const PluginDifference& difference : differences)
        warning(sentenceOf(difference), Location{project.file().string(), 0, 0});
    return differences;
}

void Session::compareWithSet()
{
    if (options_.frozen) checkFrozen(plugins(), nullptr).orThrow();
}

std::string Session::named(std::string text) const
{
    for (const auto& known : unpacked_) {
        const std::string copy = known->copy.folder().string(), packed = known->packed.string();
        for (auto at = text.find(copy); at != std::string::npos; at = text.find(copy, at + packed.size()))
            text.replace(at, copy.size(), packed);
    }
    return text;
}

void Session::tell(const std::string& text)
{
    std::fprintf(stderr, "%s\n", named(text).c_str());
    const std::lock_guard lock(mutex_);
    std::erase_if(problems_,
                  [&](const PluginProblem& problem) { return text.find(problem.reason) != std::string::npos; });
}

void Session::error(const Error& error) { tell(error.text()); }

void Session::warning(const std::string& message, const Location& where)
{
    std::string text = Error(message, where).text();
    if (const auto at = text.find("error: "); at != std::string::npos) text.replace(at, 7, "warning: ");
    tell(text);
}

std::optional<Error> Session::problem() const
{
    const std::lock_guard lock(mutex_);
    if (problems_.empty()) return std::nullopt;
    return Error(problems_.front().message);
}

bool Session::tellProblems()
{
    bool any = false;
    while (const auto waiting = problem()) {
        error(*waiting);
        any = true;
    }
    return any;
}

std::string hashText(std::uint64_t hash)
{
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
    return text;
}

}  // namespace jet::host
