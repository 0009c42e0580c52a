#include "manifest.hpp"

#include "json_places.hpp"
#include "suggest.hpp"

#include <jet/format.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>

namespace jet::host {

using Json = nlohmann::json;

namespace {

const std::vector<std::string> kFields = {"$schema",   "id",          "name",     "version",  "jet",
                                          "library",   "author",      "homepage", "requires", "optional",
                                          "conflicts", "description", "license",  "builtFor", "contributes"};

/// Fields of a contribution besides id, label and order.
std::vector<std::string> fieldsOf(ContributionKind kind)
{
    std::vector<std::string> fields = {"id", "label", "order"};
    const auto add = [&](std::initializer_list<const char*> more) {
        fields.insert(fields.end(), more.begin(), more.end());
    };
    switch (kind) {
    case ContributionKind::Tool: add({"icon", "shortcut"}); break;
    case ContributionKind::Panel: add({"icon", "shortcut", "area"}); break;
    case ContributionKind::Command: add({"icon", "shortcut", "menu"}); break;
    case ContributionKind::Importer:
    case ContributionKind::Exporter: add({"extensions", "mimeTypes"}); break;
    case ContributionKind::Effect:
    case ContributionKind::ItemType:
    case ContributionKind::SettingsPage: add({"icon"}); break;
    default: break;
    }
    return fields;
}

bool isLowerWord(std::string_view text, std::string_view more)
{
    return !text.empty() && std::all_of(text.begin(), text.end(), [&](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || more.find(c) != std::string_view::npos;
    });
}

bool isMimeType(const std::string& text)
{
    const std::size_t slash = text.find('/');
    return slash != std::string::npos && isLowerWord(text.substr(0, slash), "+-._") &&
           isLowerWord(text.substr(slash + 1), "+-._");
}

/// "/contributes/tools/0/label" as people write it: contributes.tools[0].label
std::string fieldName(std::string_view pointer)
{
    std::string name;
    while (!pointer.empty()) {
        pointer.remove_prefix(1);
        const std::size_t slash = std::min(pointer.find('/'), pointer.size());
        const std::string part(pointer.substr(0, slash));
        const bool index = isLowerWord(part, "") && part.find_first_not_of("0123456789") == std::string::npos;
        name += index ? "[" + part + "]" : (name.empty() ? "" : ".") + part;
        pointer.remove_prefix(slash);
    }
    return name;
}

class ManifestReader {
public:
    ManifestReader(const std::string& text, std::string file) : text_(text), file_(std::move(file)) {}

    Manifest read()
    {
        const Json json = parse();
        if (!json.is_object()) fail("", "a manifest is a JSON object: { \"id\": ..., ... }");
        manifest_.id = string(json, "", "id");
        checkId("/id", manifest_.id);
        manifest_.name = string(json, "", "name");
        manifest_.library = string(json, "", "library");
        if (manifest_.library.find('/') != std::string::npos)
            fail("/library", "names a file in the plugin's own folder, without '/'");
        manifest_.version = version(json, "", "version");
        manifest_.jet = version(json, "", "jet");
        manifest_.description = optionalString(json, "", "description");
        manifest_.license = optionalString(json, "", "license");
        manifest_.author = optionalString(json, "", "author");
        manifest_.homepage = optionalString(json, "", "homepage");
        optionalString(json, "", "$schema");
        readBuild(json);
        manifest_.requires_ = dependencies(json, "requires");
        manifest_.optional = dependencies(json, "optional");
        manifest_.conflicts = dependencies(json, "conflicts");
        if (json.contains("contributes")) readContributions(json["contributes"]);
        warnOfUnknown(json, "", kFields);
        return std::move(manifest_);
    }

private:
    Json parse()
    {
        try {
            return Json::parse(text_, nullptr, true, true);
        } catch (const Json::parse_error& e) {
            std::string what = e.what();
            if (const auto colon = what.find("syntax error"); colon != std::string::npos) what = what.substr(colon);
            throw Failure(Error("this manifest is not valid JSON: " + what,
                                JsonPlaces::at(text_, e.byte > 0 ? e.byte - 1 : 0, file_)));
        }
    }

    // --- messages

    Error problem(const std::string& pointer, const std::string& what)
    {
        if (!places_) places_ = std::make_unique<JsonPlaces>(text_, file_);
        const std::string field = fieldName(pointer);
        return Error((field.empty() ? "" : "\"" + field + "\": ") + what, places_->of(pointer));
    }
    [[noreturn]] void fail(const std::string& pointer, const std::string& what)
    {
        throw Failure(problem(pointer, what));
    }
    void warn(const std::string& pointer, const std::string& what)
    {
        manifest_.warnings.push_back(problem(pointer, what));
    }
    void warnOfUnknown(const Json& object, const std::string& pointer, const std::vector<std::string>& known)
    {
        for (const auto& [key, value] : object.items())
            if (std::find(known.begin(), known.end(), key) == known.end())
                warn(pointer + "/" + key, "this field is not known here and means nothing" + didYouMean(key, known));
    }

    // --- values

    std::string string(const Json& json, const std::string& pointer, const char* field)
    {
        if (!json.contains(field)) fail(pointer + "/" + field, "this field is missing; add it to the manifest");
        if (!json[field].is_string() || json[field].get_ref<const std::string&>().empty())
            fail(pointer + "/" + field, "must be a text that is not empty");
        return json[field];
    }

    std::string optionalString(const Json& json, const std::string& pointer, const char* field)
    {
        if (!json.contains(field)) return {};
        if (!json[field].is_string()) fail(pointer + "/" + field, "must be a text");
        return json[field];
    }

    Version version(const Json& json, const std::string& pointer, const char* field)
    {
        const auto parsed = Version::parse(string(json, pointer, field));
        if (!parsed) fail(pointer + "/" + field, parsed.error().message);
        return *parsed;
    }

    std::vector<std::string> strings(const Json& list, const std::string& pointer, const std::string& expected)
    {
        if (!list.is_array()) fail(pointer, "must be " + expected);
        std::vector<std::string> texts;
        for (std::size_t i = 0; i < list.size(); ++i) {
            if (!list[i].is_string()) fail(pointer + "/" + std::to_string(i), "must be a text: " + expected);
            texts.push_back(list[i]);
        }
        return texts;
    }

    void checkId(const std::string& pointer, const std::string& id)
    {
        if (!isPluginId(id))
            fail(pointer,
                 "'" + id +
                     "' is not an id; write it as org.example.name: lower-case letters, digits, '-', '_' and dots");
    }

    void readBuild(const Json& json)
    {
        if (!json.contains("builtFor")) return;
        const Json& built = json["builtFor"];
        if (!built.is_object()) fail("/builtFor", "must be an object with \"sdk\" and \"abi\", as the build writes it");
        manifest_.sdk = version(built, "/builtFor", "sdk").text();
        manifest_.abi = string(built, "/builtFor", "abi");
        warnOfUnknown(built, "/builtFor", {"sdk", "abi"});
    }

    std::vector<Dependency> dependencies(const Json& json, const std::string& field)
    {
        std::vector<Dependency> list;
        if (!json.contains(field)) return list;
        const std::string pointer = "/" + field;
        const auto texts =
            strings(json[field], pointer, "a list of plugin ids, each a text like \"org.example.name >=1.2 <3\"");
        for (std::size_t i = 0; i < texts.size(); ++i) {
            auto dependency = Dependency::parse(texts[i]);
            if (!dependency) fail(pointer + "/" + std::to_string(i), dependency.error().message);
            list.push_back(std::move(*dependency));
        }
        return list;
    }

    // --- contributions

    void readContributions(const Json& json)
    {
        if (!json.is_object()) fail("/contributes", "must be an object of lists, e.g. { \"tools\": [...] }");
        std::vector<std::string> kinds;
        kinds.reserve(kContributionKinds);
        for (int k = 0; k < kContributionKinds; ++k) kinds.emplace_back(manifestKey(static_cast<ContributionKind>(k)));
        for (const auto& [key, list] : json.items()) {
            const std::string pointer = "/contributes/" + key;
            const auto known = std::find(kinds.begin(), kinds.end(), key);
            if (known == kinds.end()) {
                warn(pointer, "this JET knows no such kind of contribution" + didYouMean(key, kinds));
                continue;
            }
            const auto kind = static_cast<ContributionKind>(known - kinds.begin());
            if (!list.is_array()) fail(pointer, "must be a list");
            std::set<std::string> ids;
            for (std::size_t i = 0; i < list.size(); ++i) {
                const std::string here = pointer + "/" + std::to_string(i);
                Contribution one = readContribution(list[i], kind, here);
                if (!ids.insert(one.id).second) fail(here + "/id", "declares '" + one.id + "' twice");
                manifest_.contributions.push_back(std::move(one));
            }
        }
    }

    Contribution readContribution(const Json& entry, ContributionKind kind, const std::string& pointer)
    {
        if (!entry.is_object()) fail(pointer, "each entry must be an object with \"id\" and \"label\"");
        Contribution one;
        one.kind = kind;
        one.plugin = manifest_.id;
        one.id = string(entry, pointer, "id");
        one.label = string(entry, pointer, "label");
        one.icon = optionalString(entry, pointer, "icon");
        if (entry.contains("icon") &&
            (one.icon.empty() || one.icon.front() == '/' || one.icon.find("..") != std::string::npos))
            fail(pointer + "/icon", "must name an SVG file in the plugin's own folder");
        one.shortcut = optionalString(entry, pointer, "shortcut");
        one.menu = optionalString(entry, pointer, "menu");
        one.area = optionalString(entry, pointer, "area");
        if (entry.contains("area") && one.area != "left" && one.area != "right" && one.area != "bottom")
            fail(pointer + "/area", "must be \"left\", \"right\" or \"bottom\"");
        if (entry.contains("order")) one.order = order(entry["order"], pointer + "/order");
        if (kind == ContributionKind::Importer || kind == ContributionKind::Exporter) readFormat(entry, pointer, one);
        warnOfUnknown(entry, pointer, fieldsOf(kind));
        return one;
    }

    int order(const Json& json, const std::string& pointer)
    {
        const double value = json.is_number() ? json.get<double>() : 0.5;
        if (std::floor(value) != value || std::abs(value) > 1e6)
            fail(pointer, "must be a whole number within a million");
        return static_cast<int>(value);
    }

    void readFormat(const Json& entry, const std::string& pointer, Contribution& one)
    {
        const std::string here = pointer + "/extensions";
        if (!entry.contains("extensions") || entry["extensions"] == Json::array())
            fail(here, "a format needs \"extensions\": [\"svg\", ...]");
        one.extensions = strings(entry["extensions"], here, "a list of file extensions, e.g. [\"svg\"]");
        for (std::size_t i = 0; i < one.extensions.size(); ++i)
            if (!isLowerWord(one.extensions[i], "+-_"))
                fail(here + "/" + std::to_string(i),
                     "'" + one.extensions[i] +
                         "' is not an extension; write it in lower case and without the dot, like svg");
        if (!entry.contains("mimeTypes")) return;
        const std::string mime = pointer + "/mimeTypes";
        one.mimeTypes = strings(entry["mimeTypes"], mime, "a list of MIME types, e.g. [\"image/svg+xml\"]");
        for (std::size_t i = 0; i < one.mimeTypes.size(); ++i)
            if (!isMimeType(one.mimeTypes[i]))
                fail(mime + "/" + std::to_string(i),
                     "'" + one.mimeTypes[i] + "' is not a MIME type; write it in lower case like image/svg+xml");
    }

    const std::string& text_;
    std::string file_;
    std::unique_ptr<JsonPlaces> places_;
    Manifest manifest_;
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

namespace {

/// The first text of a field in what may not be JSON any more.
std::string textOfField(const std::string& text, const std::string& field)
{
    std::size_t at = text.find('"' + field + '"');
    if (at == std::string::npos) return {};
    at = text.find_first_not_of(" \t\r\n:", at + field.size() + 2);
    if (at == std::string::npos || text[at] != '"') return {};
    const std::size_t end = text.find_first_of("\"\n", at + 1);
    if (end == std::string::npos || text[end] != '"') return {};
    return text.substr(at + 1, end - at - 1);
}

}  // namespace

Manifest Manifest::unreadable(const std::filesystem::path& file)
{
    Manifest manifest;
    const auto text = readFile(file);
    const Json json = text ? Json::parse(*text, nullptr, false, true) : Json();
    const auto field = [&](const char* name) {
        if (json.is_object())
            return json.value(name, Json()).is_string() ? json[name].get<std::string>() : std::string();
        return text ? textOfField(*text, name) : std::string();
    };
    manifest.id = field("id");
    if (!isPluginId(manifest.id)) manifest.id = file.parent_path().filename().string();
    manifest.name = field("name");
    if (manifest.name.empty()) manifest.name = manifest.id;
    return manifest;
}

}  // namespace jet::host
