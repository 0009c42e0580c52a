// The project is made in a folder of its own beside the target and then renamed, so that a failure leaves nothing.
#include "plugin_new_command.hpp"

#include <jet/format.hpp>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <map>
#include <unistd.h>

namespace jet::host {

namespace fs = std::filesystem;

namespace {

struct NewPluginOptions {
    std::string kind;      ///< a folder of the templates: "tool", "effect", ...
    std::string name;      ///< "rope-bridge"
    std::string id;        ///< empty: "org.example.<name>"
    fs::path folder;       ///< must not exist, or be empty; empty: <name> in the current folder
    fs::path prefix = {};  ///< where JET is installed: the folder that holds bin/jet; also a build folder
};

constexpr std::size_t kLongestName = 40;

[[noreturn]] void fail(const std::string& message) { throw Failure(Error(message)); }

fs::path templatesOf(const fs::path& prefix) { return prefix / "share" / "jet" / "templates"; }

bool isLower(char c) { return c >= 'a' && c <= 'z'; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// A name becomes part of ids, of a CMake target, of file names and of C++ names.
void checkName(const std::string& name)
{
    bool good = !name.empty() && isLower(name.front()) && name.back() != '-' && name.find("--") == std::string::npos;
    for (const char c : name) good = good && (isLower(c) || isDigit(c) || c == '-');
    if (!good)
        fail("'" + name + "' cannot be a plugin's name: use lower-case letters, digits and single '-' between them, " +
             "beginning with a letter, for example 'rope-bridge'");
    if (name.size() > kLongestName)
        fail("the plugin's name has " + std::to_string(name.size()) + " letters; at most " +
             std::to_string(kLongestName) + " are possible");
    constexpr std::array kTargets{"all", "clean", "docs", "help", "install", "package", "test"};
    if (std::find(kTargets.begin(), kTargets.end(), name) != kTargets.end())
        fail("a plugin cannot be called '" + name + "', because CMake has a target of that name; choose another name");
}

void checkId(const std::string& id)
{
    bool good = id.size() <= 100 && id.find('.') != std::string::npos && id.front() != '.' && id.back() != '.' &&
                id.find("..") == std::string::npos;
    for (const char c : id)
        good = good && (std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '_');
    if (!good)
        fail("'" + id + "' cannot be a plugin's id: it is words of letters, digits, '-' and '_' joined by dots, for " +
             "example 'org.acme.rope'");
}

/// "rope-bridge" → "Rope bridge", "RopeBridge", "rope_bridge".
std::string label(std::string name)
{
    std::replace(name.begin(), name.end(), '-', ' ');
    name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
    return name;
}

std::string className(const std::string& name)
{
    std::string result;
    bool begins = true;
    for (const char c : name) {
        if (c == '-') {
            begins = true;
        } else {
            result += begins ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
            begins = false;
        }
    }
    return result;
}

std::string fileName(std::string name)
{
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

/// As the inside of a string in single quotes of a shell.
std::string shellQuoted(const std::string& text)
{
    std::string result;
    for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result;
}

using Words = std::vector<std::pair<std::string, std::string>>;

/// What the words of the templates become (sdk/templates/README.md), longest first.
Words wordsFor(const NewPluginOptions& options)
{
    return {{"org.example.my-plugin", options.id}, {"my-jet-prefix", shellQuoted(options.prefix.string())},
            {"my-plugin", options.name},           {"my_plugin", fileName(options.name)},
            {"My plugin", label(options.name)},    {"MyPlugin", className(options.name)}};
}

/// One pass from left to right, so that what was put in is not looked at again.
std::string replaced(std::string_view text, const Words& words)
{
    std::string result;
    while (!text.empty()) {
        const auto word =
            std::find_if(words.begin(), words.end(), [&](const auto& w) { return text.starts_with(w.first); });
        result += word == words.end() ? std::string(1, text.front()) : word->second;
        text.remove_prefix(word == words.end() ? 1 : word->first.size());
    }
    return result;
}

/// The template's files by their path in the project: those of the kind before the common ones.
std::map<fs::path, fs::path> filesOf(const fs::path& templates, const std::string& kind)
{
    std::map<fs::path, fs::path> files;
    for (const fs::path& folder : {templates / kind, templates / "common"}) {
        for (const auto& entry : fs::recursive_directory_iterator(folder)) {
            if (!entry.is_regular_file()) continue;
            std::string name = entry.path().lexically_relative(folder).generic_string();
            if (name == "gitignore" || name.starts_with("github/")) name.insert(0, ".");
            files.emplace(name, entry.path());
        }
    }
    return files;
}

void checkTarget(const fs::path& folder)
{
    const auto status = fs::status(folder);
    if (!fs::exists(status)) return;
    if (!fs::is_directory(status)) fail(folder.string() + " is a file; name a folder that does not exist yet");
    if (!fs::is_empty(folder)) fail(folder.string() + " is not empty; name a folder that does not exist yet");
}

/// Removes the half-made project unless it was moved to its place.
class Scratch {
public:
    explicit Scratch(const fs::path& target)
        : path_(target.parent_path() / ("." + target.filename().string() + ".new-" + std::to_string(::getpid())))
    {
        fs::create_directories(path_);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    ~Scratch()
    {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

std::vector<std::string> write(const NewPluginOptions& options)
{
    const Words words = wordsFor(options);
    const Scratch scratch(options.folder);
    std::vector<std::string> written;
    for (const auto& [name, source] : filesOf(templatesOf(options.prefix), options.kind)) {
        written.push_back(replaced(name.generic_string(), words));
        const fs::path file = scratch.path() / written.back();
        fs::create_directories(file.parent_path());
        writeFileAtomically(file, replaced(readFile(source).orThrow(), words)).orThrow();
        fs::permissions(file, fs::status(source).permissions() | fs::perms::owner_write);
    }
    fs::rename(scratch.path(), options.folder);  // replaces an empty folder
    return written;
}

std::string joined(const std::vector<std::string>& words)
{
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

void report(const Session& session, const NewPluginOptions& options, const std::vector<std::string>& files)
{
    const fs::path plugins = options.folder / "build" / "lib" / "jet" / "plugins";
    if (session.options().json) {
        const nlohmann::ordered_json json{{"kind", options.kind},
                                          {"id", options.id},
                                          {"folder", options.folder.string()},
                                          {"files", files},
                                          {"build", (options.folder / "build.sh").string()},
                                          {"pluginPath", plugins.string()}};
        std::printf("%s\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
        return;
    }
    std::printf("made the %s '%s' (%s) in %s\n", options.kind.c_str(), options.name.c_str(), options.id.c_str(),
                options.folder.c_str());
    std::printf("build and test it:  '%s'\n", shellQuoted((options.folder / "build.sh").string()).c_str());
    std::printf("the editor with it: '%s' --plugin-path '%s'\n",
                shellQuoted((options.prefix / "bin" / "jet").string()).c_str(), shellQuoted(plugins.string()).c_str());
}

fs::path installationPrefix() { return fs::read_symlink("/proc/self/exe").parent_path().parent_path(); }

std::vector<std::string> templateKinds(const fs::path& prefix)
{
    std::vector<std::string> kinds;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(templatesOf(prefix), none))
        if (entry.is_directory() && entry.path().filename() != "common") kinds.push_back(entry.path().filename());
    std::sort(kinds.begin(), kinds.end());
    return kinds;
}

/// The options with what was not given filled in; throws Failure for what cannot be.
NewPluginOptions completed(NewPluginOptions options)
{
    options.prefix = installationPrefix();
    if (options.id.empty()) options.id = "org.example." + options.name;
    if (options.folder.empty()) options.folder = options.name;
    const auto kinds = templateKinds(options.prefix);
    if (kinds.empty())
        fail("there are no templates in " + templatesOf(options.prefix).string() + "; install JET again");
    if (std::find(kinds.begin(), kinds.end(), options.kind) == kinds.end())
        fail("there is no template for a '" + options.kind + "'; the kinds are: " + joined(kinds));
    checkName(options.name);
    checkId(options.id);
    options.folder = fs::absolute(options.folder).lexically_normal();
    if (options.folder.filename().empty()) options.folder = options.folder.parent_path();  // "rope/"
    return options;
}

int newPlugin(Session& session, const NewPluginOptions& given)
{
    NewPluginOptions options;
    try {
        options = completed(given);
    } catch (const Failure& failure) {
        session.error(failure.error());
        return kUsage;
    }
    try {
        checkTarget(options.folder);
        report(session, options, write(options));
    } catch (const fs::filesystem_error& problem) {
        fail("the project cannot be written to " + options.folder.string() + ": " + problem.code().message());
    }
    return kOk;
}

}  // namespace

void addNewPluginCommand(CLI::App& plugins, std::function<int(Session&)>& run)
{
    const auto options = std::make_shared<NewPluginOptions>();
    auto* command = plugins.add_subcommand("new", "Start a plugin: a project that builds, with a test");
    command
        ->add_option("kind", options->kind, "tool, effect, importer, exporter, panel, command, item, script or physics")
        ->required()
        ->type_name("KIND");
    command->add_option("name", options->name, "Lower-case words joined by '-', e.g. rope-bridge")
        ->required()
        ->type_name("NAME");
    command->add_option("folder", options->folder, "Folder to make; NAME if not given")->type_name("DIR");
    command->add_option("--id", options->id, "Plugin id; org.example.NAME if not given")->type_name("ID");
    command->callback([&run, options] { run = [options](Session& s) { return newPlugin(s, *options); }; });
}

}  // namespace jet::host
