// docs/file-format.md says of each item type and of the scene what the property tables say: ids, kinds, units and
// defaults, nothing missing and nothing too much.
#include "test_paths.hpp"

#include <jet/catalog.hpp>
#include <jet/item_type.hpp>
#include <jet/scene.hpp>

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace jet {
namespace {

std::string page()
{
    std::ostringstream all;
    all << std::ifstream(std::string(JET_SOURCE_DIR) + "/docs/file-format.md").rdbuf();
    return all.str();
}

std::string kindWord(ValueKind kind)
{
    static const std::map<ValueKind, std::string> words{
        {ValueKind::Bool, "bool"},     {ValueKind::Integer, "integer"}, {ValueKind::Real, "real"},
        {ValueKind::Vec2, "vector"},   {ValueKind::Color, "colour"},    {ValueKind::Text, "text"},
        {ValueKind::Choice, "choice"}, {ValueKind::Item, "item"},       {ValueKind::Path, "path"},
    };
    return words.at(kind);
}

/// How the page words a property.
std::string worded(const PropertySpec& spec)
{
    std::string text = "`" + spec.id + "` " + kindWord(spec.kind);
    if (spec.kind == ValueKind::Choice) {
        for (const std::string& choice : spec.choices)
            text += (&choice == &spec.choices[0] ? " of `" : ", `") + choice + "`";
        return text;
    }
    if (!spec.unit.empty()) text += ", " + spec.unit;
    const std::string fallback = spec.fallback.text();
    if (spec.id == "code") return text;  // empty, as nobody needs to be told
    return text + (fallback.empty() ? ", empty" : ", `" + fallback + "`");
}

/// The cells of the row whose first cell names `id`.
std::vector<std::string> row(const std::string& text, const std::string& id)
{
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("| ")) continue;
        std::vector<std::string> cells;
        std::istringstream rest(line);
        for (std::string cell; std::getline(rest, cell, '|');) cells.push_back(cell);
        if (cells.size() > 3 && cells[1].find("`" + id + "`") != std::string::npos) return cells;
    }
    return {};
}

TEST(PropertyDocs, TheTableOfItemTypesIsTheTablesInCode)
{
    const std::string all = page();
    const std::string types = all.substr(all.find("## What each item type knows"));
    for (const std::string_view id : builtInItemTypeIds()) {
        const auto cells = row(types, std::string(id));
        ASSERT_FALSE(cells.empty()) << id << " is not in the table";
        std::set<std::string> declared;
        for (const PropertySpec& spec : builtInItemType(id)->properties().specs()) {
            declared.insert(spec.id);
            EXPECT_NE(cells[3].find(worded(spec)), std::string::npos) << id << ": " << worded(spec);
        }
        static const std::regex property("`([a-z-]+)` (bool|integer|real|vector|colour|text|choice|item|path)\\b");
        for (auto found = std::sregex_iterator(cells[3].begin(), cells[3].end(), property);
             found != std::sregex_iterator(); ++found)
            EXPECT_TRUE(declared.contains((*found)[1])) << id << " has no property " << (*found)[1];
    }
}

TEST(PropertyDocs, TheTableOfSettingsIsTheTableInCode)
{
    const std::string all = page();
    const std::string settings = all.substr(all.find("**Settings**"));
    for (const PropertySpec& spec : Scene::settingsTable().specs()) {
        const auto cells = row(settings, spec.id);
        ASSERT_FALSE(cells.empty()) << spec.id << " is not in the table";
        EXPECT_EQ(cells[2].find(" " + kindWord(spec.kind)), 0u) << spec.id;
        EXPECT_NE(cells[2].find(spec.unit), std::string::npos) << spec.id;
        const std::string fallback = spec.fallback.text();
        EXPECT_NE(cells[3].find(fallback.empty() ? "empty" : "`" + fallback + "`"), std::string::npos) << spec.id;
    }
}

}  // namespace
}  // namespace jet
