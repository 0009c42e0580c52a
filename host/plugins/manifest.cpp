#include "manifest.hpp"

#include <jet/format.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <set>

namespace jet::host {

using Json = nlohmann::json;

std::string Version::text() const
{
    return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

Result<Version> Version::parse(std::string_view text)
{
    Version version;
    int* const parts[] = {&version.major, &version.minor, &version.patch};
    const char* at = text.data();
    const char* const end = text.data() + text.size();
    for (int* part : parts) {
        const auto [next, problem] = std::from_chars(at, end, *part);
        if (problem != std::errc() || *part < 0) break;
        if (next == end) return version;
        if (*next != '.') break;
        at = next + 1;
    }
    return Error("'" + std::string(text) + "' is not a version; write it as 1.2.3");
}

namespace {

class ManifestReader {
public:
    ManifestReader(const std::string& text, std::string file) : text_(text), file_(std::move(file)) {}

    Manifest read()
    {
        const Json json = parse();
        if (!json.is_object()) fail("", "a manifest is a JSON object: { \"id\": ..., ... }");
        Manifest manifest;
        manifest.id = string(json, "id");
        checkId(manifest.id);
        manifest.name = string(json, "name");
        manifest.library = string(json, "library");
        if (manifest.library.find('/') != std::string::npos)
            fail("library", "names a file in the plugin's own folder, without '/'");
        manifest.version = version(json, "version");
        manifest.jet = version(json, "jet");
        manifest.description = optionalString(json, "description");
        manifest.license = optionalString(json, "license");
        if (json.contains("builtFor")) {
            manifest.sdk = string(json["builtFor"], "sdk");
            manifest.abi = string(json["builtFor"], "abi");
        }
        manifest.requires_ = dependencies(json, "requires");
        manifest.optional = dependencies(json, "optional");
        if (json.contains("contributes")) readContributions(json["contributes"], manifest);
        return manifest;
    }

private:
    Json parse()
    {
        try {
            return Json::parse(text_, nullptr, true, true);
        } catch (const Json::parse_error& e) {
            std::string what = e.what();
            if (const auto colon = what.find("syntax error"); colon != std::string::npos) what = what.substr(colon);
            throw Failure(Error("this manifest is not valid JSON: " + what, at(e.byte > 0 ? e.byte - 1 : 0)));
        }
    }

    Location at(std::size_t offset) const
    {
        offset = std::min(offset, text_.size());
        const auto begin = text_.begin();
        const auto here = begin + static_cast<std::ptrdiff_t>(offset);
        const std::size_t lineStart = text_.rfind('\n', offset == 0 ? 0 : offset - 1);
        const bool first = lineStart == std::string::npos || offset == 0;
        return {file_, static_cast<int>(std::count(begin, here, '\n')) + 1,
                static_cast<int>(first ? offset + 1 : offset - lineStart)};
    }

    [[noreturn]] void fail(const std::string& field, const std::string& problem) const
    {
        const std::size_t found = field.empty() ? 0 : text_.find('"' + field + '"');
        const Location where = found == std::string::npos ? Location{file_, 1, 1} : at(found);
        throw Failure(Error((field.empty() ? "" : "\"" + field + "\": ") + problem, where));
    }

    std::string string(const Json& json, const char* field) const
    {
        if (!json.contains(field)) fail(field, std::string("this field is missing; add it to the manifest"));
        if (!json[field].is_string() || json[field].get_ref<const std::string&>().empty())
            fail(field, "must be a text that is not empty");
        return json[field];
    }

    std::string optionalString(const Json& json, const char* field) const
    {
        if (!json.contains(field)) return {};
        if (!json[field].is_string()) fail(field, "must be a text");
        return json[field];
    }

    Version version(const Json& json, const char* field) const
    {
        const auto parsed = Version::parse(string(json, field));
        if (!parsed) fail(field, parsed.error().message);
        return *parsed;
    }

    void checkId(const std::string& id) const
    {
        const bool plain = std::all_of(id.begin(), id.end(), [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '_';
        });
        if (!plain || id.find('.') == std::string::npos || id.front() == '.' || id.back() == '.')
            fail("id",
                 "'" + id +
                     "' is not an id; write it as org.example.name: lower-case letters, digits, '-', '_' and dots");
    }

    std::vector<Dependency> dependencies(const Json& json, const char* field) const
    {
        std::vector<Dependency> list;
        if (!json.contains(field)) return list;
        if (!json[field].is_array()) fail(field, "must be a list of plugin ids");
        for (const Json& entry : json[field]) {
            if (!entry.is_string())
                fail(field, "must be a list of plugin ids, each a text like \"org.example.name 1.2\"");
            const std::string text = entry;
            const std::size_t space = text.find(' ');
            Dependency dependency{text.substr(0, space), {}};
            if (space != std::string::npos) {
                const auto minimum = Version::parse(text.substr(space + 1));
                if (!minimum) fail(field, minimum.error().message);
                dependency.minimum = *minimum;
            }
            list.push_back(std::move(dependency));
        }
        return list;
    }

    void readContributions(const Json& json, Manifest& manifest) const
    {
        if (!json.is_object()) fail("contributes", "must be an object of lists, e.g. { \"tools\": [...] }");
        for (const auto& [key, list] : json.items()) {
            const auto kind = kindOf(key);
            if (!list.is_array()) fail(key, "must be a list");
            std::set<std::string> ids;
            for (const Json& entry : list) {
                Contribution one = readContribution(entry, kind, key);
                one.plugin = manifest.id;
                if (!ids.insert(one.id).second) fail(key, "declares '" + one.id + "' twice");
                manifest.contributions.push_back(std::move(one));
            }
        }
    }

    ContributionKind kindOf(const std::string& key) const
    {
        for (int k = 0; k < kContributionKinds; ++k)
            if (manifestKey(static_cast<ContributionKind>(k)) == key) return static_cast<ContributionKind>(k);
        std::string known;
        for (int k = 0; k < kContributionKinds; ++k)
            known += (k ? ", " : "") + std::string(manifestKey(static_cast<ContributionKind>(k)));
        fail(key, "is not a kind of contribution; known are " + known);
    }

    Contribution readContribution(const Json& entry, ContributionKind kind, const std::string& key) const
    {
        if (!entry.is_object()) fail(key, "each entry must be an object with \"id\" and \"label\"");
        Contribution one;
        one.kind = kind;
        one.id = string(entry, "id");
        one.label = string(entry, "label");
        one.icon = optionalString(entry, "icon");
        one.shortcut = optionalString(entry, "shortcut");
        one.menu = optionalString(entry, "menu");
        one.area = optionalString(entry, "area");
        if (entry.contains("order")) {
            if (!entry["order"].is_number_integer()) fail("order", "must be a whole number");
            one.order = entry["order"];
        }
        const bool isFormat = kind == ContributionKind::Importer || kind == ContributionKind::Exporter;
        if (isFormat) {
            if (!entry.contains("extensions") || !entry["extensions"].is_array() || entry["extensions"].empty())
                fail(key, "a format needs \"extensions\": [\"svg\", ...]");
            for (const Json& extension : entry["extensions"]) {
                if (!extension.is_string()) fail("extensions", "must be a list of texts");
                one.extensions.push_back(extension);
            }
        }
        return one;
    }

    const std::string& text_;
    std::string file_;
};

}  // namespace

Result<Manifest> Manifest::parse(const std::string& text, const std::filesystem::path& file)
{
    try {
        return ManifestReader(text, file.string()).read();
    } catch (const Failure& failure) {
        return failure.error();
    } catch (const Json::exception& e) {
        return Error(std::string("this manifest cannot be read: ") + e.what(), Location{file.string(), 1, 1});
    }
}

Result<Manifest> Manifest::read(const std::filesystem::path& file)
{
    const auto text = readFile(file);
    if (!text) return text.error();
    return parse(*text, file);
}

}  // namespace jet::host
