#include "session.hpp"

#include "host/plugins/project_trust.hpp"
#include "host/projects/project_archive.hpp"

#include <jet/format.hpp>

#include <nlohmann/json.hpp>

#include <cstdio>

namespace jet::host {

namespace fs = std::filesystem;

namespace {

// A set is JSON: { "name": "...", "plugins": ["org.jet.…", …] }; by path, or by name beside the built-in plugins.
std::set<std::string> readSet(const std::string& name)
{
    fs::path file = name;
    if (file.extension() != ".jetset") file = builtInPluginFolder().parent_path() / "sets" / (name + ".jetset");
    const auto text = readFile(file);
    if (!text) throw Failure(text.error());
    const auto json = nlohmann::json::parse(*text, nullptr, false, true);
    if (!json.is_object() || !json.contains("plugins") || !json["plugins"].is_array())
        throw Failure(Error("a plugin set is { \"name\": ..., \"plugins\": [ids] }", Location{file.string(), 1, 1}));
    std::set<std::string> ids;
    for (const auto& id : json["plugins"])
        if (id.is_string()) ids.insert(id.get<std::string>());
    return ids;
}

}  // namespace

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

PluginManager& Session::plugins()
{
    if (plugins_) return *plugins_;
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
    if (!options_.set.empty()) {
        options.only = readSet(options_.set);
        options.setName = fs::path(options_.set).stem().string();
    }
    plugins_ = std::make_unique<PluginManager>(std::move(options));
    plugins_->setProblemHandler([this](const PluginProblem& problem) {
        const std::lock_guard lock(mutex_);
        problems_.push_back(problem);
    });
    plugins_->setHangHandler([this](const PluginProblem& problem) { warning(problem.message); });
    plugins_->scan();
    static const CrashLedger ledger(CrashLedger::defaultFolder());  // one a process
    watchdog_ = std::make_unique<Watchdog>();
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
    auto found = findProjectPlugins(readable(project));
    if (!found) return;
    // Trust is in a folder that stays: the copy is another one each time.
    if (isPackedProject(project))
        return warning("the plugins of a packed project are left out; unpack it with 'jet project unpack' to use them",
                       Location{project.string(), 0, 0});
    if (options_.safeMode) return warning("the plugins of the project are left out in safe mode");
    if (options_.trust && !found->isTrusted()) {
        trustProject(*found).orThrow();
        found->trust = ProjectPlugins::Trust::Trusted;
    }
    if (!found->isTrusted()) return warning(found->advice());
    plugins().addFolder(found->folder, PluginOrigin::Project);
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
