#include "plugin_set_files.hpp"

#include "json_places.hpp"
#include "plugin_manager.hpp"
#include "suggest.hpp"
#include "user_choice.hpp"

#include <jet/format.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace jet::host {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

constexpr const char* kExtension = ".jetset";
constexpr const char* kProjectName = "project";

bool isFile(const std::string& text)
{
    return fs::path(text).extension() == kExtension || text.find('/') != std::string::npos;
}

/// Reads a file and what it includes.
class SetReader {
public:
    explicit SetReader(const PluginSetFiles& files) : files_(files) {}

    PluginSet read(const std::string& nameOrFile, const Location& from)
    {
        const PluginSetFiles::Listed found = find(nameOrFile, from);
        std::error_code ignored;
        const fs::path whole = fs::weakly_canonical(found.file, ignored);
        const auto again = std::find(chain_.begin(), chain_.end(), whole);
        if (again != chain_.end())
            throw Failure(
                Error("the set includes itself: " + chainText(again, whole) + "; remove one of these includes", from));
        auto text = readFile(found.file);
        if (!text) throw Failure(from.line > 0 ? Error(text.error().text(), from) : text.error());
        chain_.push_back(whole);
        folders_.push_back(found.file.parent_path());
        PluginSet set = parse(*text, found.file.string());
        set.name = found.name;
        if (set.title.empty()) set.title = found.name;
        set.source = found.source;
        set.file = found.file;
        folders_.pop_back();
        chain_.pop_back();
        return set;
    }

private:
    /// One file being read: its values and their places.
    struct Source {
        const Json& json;
        const JsonPlaces& places;

        [[noreturn]] void fail(const std::string& pointer, const std::string& what) const
        {
            throw Failure(Error(what, places.of(pointer)));
        }
        std::string text(const char* field) const
        {
            if (!json.contains(field)) return {};
            if (!json[field].is_string()) fail(std::string("/") + field, std::string(field) + " must be a text");
            return json[field].get<std::string>();
        }
        std::vector<std::string> list(const char* field, const std::string& what) const
        {
            std::vector<std::string> texts;
            if (!json.contains(field)) return texts;
            const std::string pointer = std::string("/") + field;
            if (!json[field].is_array()) fail(pointer, std::string(field) + " must be a list of " + what);
            for (std::size_t i = 0; i < json[field].size(); ++i) {
                if (!json[field][i].is_string())
                    fail(pointer + "/" + std::to_string(i), "an entry of " + std::string(field) + " must be " + what);
                texts.push_back(json[field][i].get<std::string>());
            }
            return texts;
        }
        Location of(const char* field, std::size_t index) const
        {
            return places.of(std::string("/") + field + "/" + std::to_string(index));
        }
    };

    PluginSet parse(const std::string& text, const std::string& file)
    {
        Json json;
        try {
            json = Json::parse(text, nullptr, true, true);
        } catch (const Json::parse_error& e) {
            throw Failure(
                Error("this plugin set is not valid JSON", JsonPlaces::at(text, e.byte > 0 ? e.byte - 1 : 0, file)));
        }
        const JsonPlaces places(text, file);
        const Source source{json, places};
        if (!json.is_object()) source.fail("", "a plugin set is { \"name\": …, \"plugins\": [ids] }");
        PluginSet set;
        set.title = source.text("name");
        set.description = source.text("description");
        source.text("$schema");
        warnOfUnknown(source, set);
        const auto includes = source.list("include", "names or files of sets");
        for (std::size_t i = 0; i < includes.size(); ++i) {
            if (includes[i].empty()) throw Failure(Error("an entry of include is empty", source.of("include", i)));
            set.includes.push_back(read(includes[i], source.of("include", i)));
        }
        const std::string ids = "plugin ids, each a text like \"org.example.name >=1.2 <3\"";
        readEntries(source, "plugins", ids, set.plugins);
        readEntries(source, "optional", ids, set.plugins);
        readEntries(source, "exclude", "plugin ids", set.excluded);
        if (!json.contains("plugins") && set.includes.empty())
            source.fail("", "a plugin set is { \"name\": …, \"plugins\": [ids] }, or it includes other sets");
        return set;
    }

    static void warnOfUnknown(const Source& source, PluginSet& set)
    {
        static const std::vector<std::string> known{"name",     "description", "include", "plugins",
                                                    "optional", "exclude",     "$schema"};
        for (const auto& [field, value] : source.json.items())
            if (std::find(known.begin(), known.end(), field) == known.end())
                set.warnings.push_back(
                    Error("this JET knows no field '" + field + "' of plugin sets" + didYouMean(field, known),
                          source.places.of("/" + field)));
    }

    static void readEntries(const Source& source, const char* field, const std::string& what,
                            std::vector<PluginSet::Entry>& entries)
    {
        const auto texts = source.list(field, what);
        for (std::size_t i = 0; i < texts.size(); ++i) {
            PluginSet::Entry entry;
            entry.where = source.of(field, i);
            entry.optional = std::string_view(field) == "optional";
            auto plugin = readEntry(texts[i]);
            if (!plugin) throw Failure(Error(plugin.error().message, entry.where));
            entry.plugin = std::move(*plugin);
            if (std::string_view(field) == "exclude" && !entry.plugin.range.isAny())
                throw Failure(Error("an exclusion takes no versions; write \"" + entry.plugin.id +
                                        "\", or ask for other versions under plugins",
                                    entry.where));
            entries.push_back(std::move(entry));
        }
    }

    /// An id with a range of versions, or the beginning of ids and a star.
    static Result<Dependency> readEntry(const std::string& text)
    {
        if (!text.ends_with('*') || text.find(' ') != std::string::npos) return Dependency::parse(text);
        // What begins an id becomes one with a letter and a part more.
        if (!isPluginId(text.substr(0, text.size() - 1) + "x.x"))
            return Error("'" + text + "' begins no id; write it as org.example.*");
        return Dependency{text, {}};
    }

    PluginSetFiles::Listed find(const std::string& nameOrFile, const Location& from) const
    {
        if (isFile(nameOrFile)) {
            const fs::path beside = folders_.empty() ? fs::path() : folders_.back();
            const fs::path file = (beside / nameOrFile).lexically_normal();
            return {file.stem().string(), SetSource::CommandLine, file};
        }
        std::vector<std::string> names;
        for (PluginSetFiles::Listed& one : files_.list()) {
            if (one.name == nameOrFile) return one;
            names.push_back(one.name);
        }
        if (nameOrFile == kProjectName)
            throw Failure(Error("this project has no plugins.jetset beside its project.jet; 'jet plugins freeze "
                                "PROJECT -o plugins.jetset' writes one",
                                from));
        std::string all;
        for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
        const std::string guess = didYouMean(nameOrFile, names);
        throw Failure(Error("there is no plugin set '" + nameOrFile + "'" +
                                (guess.empty() && !all.empty() ? "; there are " + all : guess),
                            from));
    }

    std::string chainText(std::vector<fs::path>::const_iterator first, const fs::path& last) const
    {
        std::string text;
        for (auto file = first; file != chain_.end(); ++file) text += file->filename().string() + " → ";
        return text + last.filename().string();
    }

    const PluginSetFiles& files_;
    std::vector<fs::path> chain_;    // of files that are being read
    std::vector<fs::path> folders_;  // theirs, as they were named
};

std::vector<fs::path> setFilesIn(const fs::path& folder)
{
    std::vector<fs::path> files;
    std::error_code ignored;
    if (folder.empty()) return files;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
        if (entry.path().extension() == kExtension) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

std::vector<std::string> parts(const std::string& text)
{
    std::vector<std::string> words;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t comma = std::min(text.find(',', at), text.size());
        std::string word = text.substr(at, comma - at);
        word.erase(0, std::min(word.find_first_not_of(' '), word.size()));
        word.erase(word.find_last_not_of(' ') + 1);
        words.push_back(std::move(word));
        at = comma + 1;
    }
    return words;
}

}  // namespace

PluginSetFiles::PluginSetFiles(const fs::path& project)
{
    if (project.empty()) return;
    std::error_code ignored;
    projectFile_ = (fs::is_directory(project, ignored) ? project : project.parent_path()) / "plugins.jetset";
}

fs::path PluginSetFiles::userFolder()
{
    const fs::path config = userConfigFolder();
    return config.empty() ? config : config / "sets";
}

fs::path PluginSetFiles::shippedFolder()
{
    // The library's folder differs between systems (lib, lib64, lib/x86_64-linux-gnu); share lies beside the first
    // part.
    std::error_code ignored;
    for (fs::path folder = builtInPluginFolder(); folder.has_relative_path(); folder = folder.parent_path())
        if (fs::is_directory(folder / "share/jet/sets", ignored)) return folder / "share/jet/sets";
    return {};
}

std::vector<PluginSetFiles::Listed> PluginSetFiles::list() const
{
    std::vector<Listed> sets;
    std::error_code ignored;
    if (!projectFile_.empty() && fs::exists(projectFile_, ignored))
        sets.push_back({kProjectName, SetSource::Project, projectFile_});
    std::set<std::string> seen{kProjectName};
    const auto add = [&](const fs::path& folder, SetSource source) {
        for (const fs::path& file : setFilesIn(folder))
            if (seen.insert(file.stem().string()).second) sets.push_back({file.stem().string(), source, file});
    };
    add(userFolder(), SetSource::User);
    add(shippedFolder(), SetSource::Shipped);
    return sets;
}

Result<PluginSet> PluginSetFiles::read(const std::string& nameOrFile) const
{
    try {
        return SetReader(*this).read(nameOrFile, {});
    } catch (const Failure& failure) {
        return failure.error();
    }
}

Result<PluginSet> PluginSetFiles::choose(const std::string& text) const
{
    const auto words = parts(text);
    // A lone word without a dot is a set's name, even where there is no such set: the error then tells of sets.
    const auto isId = [](const std::string& word) {
        return !isFile(word) && isPluginId(word.substr(0, word.find(' ')));
    };
    if (words.size() == 1 && !isId(words.front())) return read(words.front());
    PluginSet set;
    set.name = set.title = text;
    for (const std::string& word : words) {
        if (isId(word)) {
            auto plugin = Dependency::parse(word);
            if (!plugin) return Error("--plugins: " + plugin.error().message);
            set.plugins.push_back({std::move(*plugin), false, {}});
        } else if (auto other = read(word)) {
            set.includes.push_back(std::move(*other));
        } else {
            return other.error();
        }
    }
    return set;
}

std::optional<Result<PluginSet>> PluginSetFiles::ofProject() const
{
    std::error_code ignored;
    if (projectFile_.empty() || !fs::exists(projectFile_, ignored)) return std::nullopt;
    return read(kProjectName);
}

std::string readChosenSet()
{
    const fs::path file = userConfigFolder() / "plugin-set";
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return {};
    const auto text = readFile(file);
    return text ? text->substr(0, text->find('\n')) : std::string();
}

Result<void> writeChosenSet(const std::string& name)
{
    const fs::path file = userConfigFolder() / "plugin-set";
    std::error_code problem;
    if (!name.empty()) {
        fs::create_directories(userConfigFolder(), problem);
        return writeFileAtomically(file, name + "\n");
    }
    fs::remove(file, problem);
    return problem ? Result<void>(Error("cannot be removed: " + problem.message(), Location{file.string(), 0, 0}))
                   : Result<void>();
}

}  // namespace jet::host
