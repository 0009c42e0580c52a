// index.json as text and back.
#include "repository.hpp"

#include "host/archive/entry_name.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace jet::host {

using Json = nlohmann::ordered_json;

namespace {

constexpr int kIndexVersion = 1;

Json jsonOf(const IndexEntry& entry)
{
    Json json{{"id", entry.id},
              {"name", entry.name},
              {"version", entry.version.text()},
              {"description", entry.description},
              {"license", entry.license},
              {"jet", entry.jet.text()},
              {"builtFor", {{"sdk", entry.sdk}, {"abi", entry.abi}}},
              {"requires", Json::array()},
              {"contributes", entry.contributions},
              {"file", entry.file},
              {"size", entry.size},
              {"sha256", entry.sha256}};
    for (const Dependency& need : entry.needs) json["requires"].push_back(need.text());
    return json;
}

/// Reads entry number `number`; every problem names the entry and its field.
class EntryReader {
public:
    EntryReader(const Json& json, std::size_t number, const std::string& file)
        : json_(json), number_(number), file_(file)
    {
    }

    IndexEntry read() const
    {
        if (!json_.is_object()) fail("", "is not an object");
        IndexEntry entry;
        entry.id = string(json_, "id");
        entry.name = string(json_, "name");
        entry.version = version(string(json_, "version"), "version");
        entry.jet = version(string(json_, "jet"), "jet");
        if (!json_.contains("builtFor") || !json_["builtFor"].is_object()) fail("builtFor", "is missing");
        entry.sdk = string(json_["builtFor"], "sdk");
        entry.abi = string(json_["builtFor"], "abi");
        entry.description = optional("description");
        entry.license = optional("license");
        entry.contributions = texts("contributes");
        for (const std::string& text : texts("requires")) entry.needs.push_back(dependency(text));
        entry.file = string(json_, "file");
        if (const auto fine = checkEntryName(entry.file); !fine)
            fail("file", shownName(entry.file) + ": " + fine.error().message);
        if (!json_.contains("size") || !json_["size"].is_number_unsigned()) fail("size", "must be a number of bytes");
        entry.size = json_["size"];
        entry.sha256 = string(json_, "sha256");
        const bool digits =
            entry.sha256.size() == 64 && entry.sha256.find_first_not_of("0123456789abcdef") == std::string::npos;
        if (!digits) fail("sha256", "must be 64 lower-case hexadecimal digits");
        return entry;
    }

private:
    [[noreturn]] void fail(const std::string& field, const std::string& problem) const
    {
        std::string who = "entry " + std::to_string(number_ + 1);
        if (json_.is_object() && json_.contains("id") && json_["id"].is_string())
            who += " (" + json_["id"].get<std::string>() + ")";
        throw Failure(Error("this index is damaged: " + who + (field.empty() ? "" : ", \"" + field + "\"") + ": " +
                                problem + "; make it again with 'jet plugins index'",
                            Location{file_, 0, 0}));
    }
    std::string string(const Json& json, const char* field) const
    {
        if (!json.contains(field) || !json[field].is_string() || json[field].get_ref<const std::string&>().empty())
            fail(field, "must be a text that is not empty");
        return json[field];
    }
    std::string optional(const char* field) const
    {
        if (!json_.contains(field)) return {};
        if (!json_[field].is_string()) fail(field, "must be a text");
        return json_[field];
    }
    std::vector<std::string> texts(const char* field) const
    {
        std::vector<std::string> list;
        if (!json_.contains(field)) return list;
        if (!json_[field].is_array()) fail(field, "must be a list of texts");
        for (const Json& one : json_[field]) {
            if (!one.is_string()) fail(field, "must be a list of texts");
            list.push_back(one);
        }
        return list;
    }
    Version version(const std::string& text, const char* field) const
    {
        const auto parsed = Version::parse(text);
        if (!parsed) fail(field, parsed.error().message);
        return *parsed;
    }
    Dependency dependency(const std::string& text) const
    {
        const std::size_t space = text.find(' ');
        Dependency need{text.substr(0, space), {}};
        if (space == std::string::npos) return need;
        const auto range = VersionRange::parse(std::string_view(text).substr(space + 1));
        if (!range) fail("requires", range.error().message);
        need.range = *range;
        return need;
    }

    const Json& json_;
    std::size_t number_;
    const std::string& file_;
};

int lineOf(const std::string& text, std::size_t offset)
{
    return 1 + static_cast<int>(std::count(
                   text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size())), '\n'));
}

}  // namespace

std::string Index::text() const
{
    Json json{{"jetRepository", kIndexVersion}, {"plugins", Json::array()}};
    for (const IndexEntry& entry : entries) json["plugins"].push_back(jsonOf(entry));
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<Index> Index::parse(const std::string& text, const std::string& file)
{
    try {
        const Json json = Json::parse(text);
        const bool known =
            json.is_object() && json.contains("jetRepository") && json["jetRepository"].is_number_integer();
        if (!known || !json.contains("plugins") || !json["plugins"].is_array())
            return Error("this is no index of a repository; 'jet plugins index DIR' makes one", Location{file, 0, 0});
        if (json["jetRepository"] != kIndexVersion)
            return Error("this index is of a later kind than this JET knows; use a newer JET", Location{file, 0, 0});
        Index index;
        std::size_t number = 0;
        for (const Json& entry : json["plugins"]) index.entries.push_back(EntryReader(entry, number++, file).read());
        std::stable_sort(index.entries.begin(), index.entries.end(), [](const auto& a, const auto& b) {
            return a.id != b.id ? a.id < b.id : a.version > b.version;
        });
        return index;
    } catch (const Failure& failure) {
        return failure.error();
    } catch (const Json::parse_error& e) {
        return Error("this index is not valid JSON; get it again, or make it with 'jet plugins index'",
                     Location{file, lineOf(text, e.byte), 0});
    } catch (const Json::exception& e) {
        return Error(std::string("this index cannot be read: ") + e.what(), Location{file, 0, 0});
    }
}

}  // namespace jet::host
