#include "migration.hpp"
#include "physics_ranges.hpp"
#include "scene_fast_reader.hpp"
#include "symbol_text.hpp"
#include "xml_text.hpp"

#include <jet/project.hpp>

#include <charconv>
#include <set>

namespace jet {

namespace {

class SceneTextReader {
public:
    SceneTextReader(XmlSource& source, Scene& scene, Catalog& catalog, std::vector<FormatNote>& notes)
        : source_(source), builder_(scene), scene_(scene), catalog_(catalog), notes_(notes)
    {
    }

    void read()
    {
        const pugi::xml_node root = source_.document.document_element();
        if (std::string_view(root.name()) != "scene")
            source_.fail(root, "a scene file starts with <scene>, this one with <" + std::string(root.name()) + ">");
        version = migrate(source_);
        source_.onlyAttributes(root, {"version"});
        for (const pugi::xml_node child : root.children()) {
            const std::string_view name = child.name();
            if (name == "settings") {
                once(child, "<settings>");
                readSettings(child);
            } else if (name == "materials") {
                once(child, "<materials>");
                readMaterials(child);
            } else if (name == "symbols") {
                once(child, "<symbols>");
                readSymbols(child);
            } else if (name == "item") {
                readItem(child, builder_.root(), 1);
            } else {
                source_.unexpected(child, "a scene holds <settings>, <materials>, <symbols> and <item>");
            }
        }
    }

    int version = kFormatVersion;  ///< of the text, told by read()
    /// Instances met so far: they have no items yet.
    std::vector<InstanceRecord>& instances() { return instances_; }

private:
    // What stands twice would be lost by half.
    void once(const pugi::xml_node& node, const std::string& what)
    {
        for (pugi::xml_node before = node.previous_sibling(node.name()); before;
             before = before.previous_sibling(node.name()))
            source_.fail(node, what + " stands here twice; keep one of them");
    }

    void setOnce(Properties& properties, const pugi::xml_node& node, std::pair<std::string, Value> property)
    {
        if (properties.find(property.first))
            source_.fail(node, "the property '" + property.first + "' stands here twice; keep one of them");
        properties.set(property.first, std::move(property.second));
    }

    void readSettings(const pugi::xml_node& node)
    {
        source_.onlyAttributes(node, {});
        for (const pugi::xml_node child : node.children()) {
            if (std::string_view(child.name()) != "property") {
                source_.unexpected(child, "<settings> holds <property>");
                continue;
            }
            if (scene_.settings().find(child.attribute("id").value()))
                source_.fail(child, std::string("the property '") + child.attribute("id").value() +
                                        "' stands here twice; keep one of them");
            auto [id, value] = readProperty(child, &Scene::settingsTable(), "a scene");
            builder_.setSetting(id, std::move(value));
        }
    }

    double number(const pugi::xml_node& node, const char* attribute)
    {
        const auto value = Value::parse(ValueKind::Real, source_.required(node, attribute));
        if (!value) source_.fail(node, std::string(attribute) + ": " + value.error().message);
        return (*value).as<double>();
    }

    void readMaterials(const pugi::xml_node& node)
    {
        source_.onlyAttributes(node, {});
        MaterialTable table;
        bool first = true;
        for (const pugi::xml_node child : node.children()) {
            if (std::string_view(child.name()) == "pair") continue;
            if (std::string_view(child.name()) != "material") {
                source_.unexpected(child, "<materials> holds <material> and <pair>");
                continue;
            }
            source_.onlyAttributes(child, {"name"});
            const std::string name(source_.required(child, "name"));
            if (!first && table.find(name) >= 0)
                source_.fail(child, "there are two materials called '" + name + "'; rename one");
            if (first) {
                table = MaterialTable(name);
            } else {
                table.add(name);
            }
            first = false;
        }
        const auto index = [&](const pugi::xml_node& pair, const char* attribute) {
            const std::string name(source_.required(pair, attribute));
            const int found = table.find(name);
            if (found < 0)
                source_.fail(pair, "there is no material '" + name + "'; declare it with <material name=\"...\"/>");
            return static_cast<std::size_t>(found);
        };
        for (const pugi::xml_node child : node.children("pair")) {
            source_.onlyAttributes(child, {"a", "b", "friction", "restitution", "collides"});
            const std::size_t a = index(child, "a"), b = index(child, "b");
            const MaterialPair pair{number(child, "friction"), number(child, "restitution"),
                                    source_.boolean(child, "collides", true)};
            if (const auto fits = checkPair(table.names()[a], table.names()[b], pair); !fits)
                source_.fail(child, fits.error().message);
            table.setPair(a, b, pair);
        }
        builder_.setMaterials(std::move(table));
    }

    std::pair<std::string, Value> readProperty(const pugi::xml_node& node, const PropertyTable* table,
                                               std::string_view owner)
    {
        source_.onlyAttributes(node, {"id"});
        std::string id(source_.required(node, "id"));
        std::string text = source_.textOf(node);
        const PropertySpec* spec = table ? table->find(id) : nullptr;
        // Without its plugin nobody knows the kind: the text is kept as it is. A property the plugin does not know is
        // kept too (a newer version of it may have written it).
        if (!spec) {
            if (table)
                notes_.push_back({"'" + std::string(owner) + "' has no property '" + id + "'; its text is kept",
                                  source_.where(node)});
            return {std::move(id), Value(RawText{std::move(text)})};
        }
        auto value = Value::parse(spec->kind, text);
        if (!value) source_.fail(node, "property '" + id + "': " + value.error().message);
        if (const auto fits = spec->check(*value); !fits) source_.fail(node, fits.error().message);
        return {std::move(id), std::move(*value)};
    }

    ItemId readId(const pugi::xml_node& node)
    {
        const std::string_view text = source_.required(node, "id");
        std::uint64_t id = 0;
        const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), id);
        if (problem != std::errc() || end != text.data() + text.size() || id == 0 || id > kMaximumId)
            source_.fail(node, "id=\"" + std::string(text) + "\" is not a whole number from 1 to " +
                                   std::to_string(kMaximumId));
        if (const Item* other = scene_.items().find(ItemId{id}))
            source_.fail(node, "the id " + std::string(text) + " is used twice, here and by '" + other->name() +
                                   "' before; give one of them a number that is free");
        return ItemId{id};
    }

    void readSymbols(const pugi::xml_node& node)
    {
        source_.onlyAttributes(node, {});
        Item& top = const_cast<Item&>(*scene_.items().find(kSymbolsId));
        for (const pugi::xml_node child : node.children()) {
            if (std::string_view(child.name()) != "symbol") {
                source_.unexpected(child, "<symbols> holds <symbol>");
                continue;
            }
            source_.onlyAttributes(child, {"id", "name", "key"});
            Item& symbol = builder_.add(top, readId(child), GroupItem::type);
            builder_.setName(symbol, std::string(source_.required(child, "name")));
            builder_.setProperties(symbol, {{std::string(kSymbolKey), Value(source_.required(child, "key"))}});
            for (const pugi::xml_node member : child.children()) {
                if (std::string_view(member.name()) == "item") {
                    readItem(member, symbol, 2);
                } else {
                    source_.unexpected(member, "a symbol holds <item>");
                }
            }
        }
    }

    void readInstance(const pugi::xml_node& node, const Item& item, Properties& properties)
    {
        source_.onlyAttributes(node, {"symbol", "matrix", "ids"});
        if (!item.is<GroupItem>()) source_.fail(node, "only an item of type 'group' can be an instance of a symbol");
        const auto number = [&](const char* attribute) { return std::string_view(node.attribute(attribute).value()); };
        const auto symbol = Value::parse(ValueKind::Item, source_.required(node, "symbol"));
        if (!symbol || !(*symbol).as<ItemId>()) source_.fail(node, "symbol=\"…\" is the id of a symbol");
        const auto placement = node.attribute("matrix") ? parseMatrix(number("matrix")) : std::optional(Affine());
        if (!placement) source_.fail(node, "matrix=\"…\" is six numbers, as in SVG: a b c d e f");
        auto ids = parseIds(number("ids"));
        if (!ids) source_.fail(node, "ids=\"…\" is a list of numbers and ranges, such as \"7 9-12\"");
        properties.set(kLinkSymbol, *symbol);
        properties.set(kLinkX, Vec2(placement->linear().col(0)));
        properties.set(kLinkY, Vec2(placement->linear().col(1)));
        properties.set(kLinkOffset, Vec2(placement->matrix().col(2)));
        instances_.push_back({item.id(), std::move(*ids), source_.where(node)});
    }

    void readItem(const pugi::xml_node& node, Item& parent, std::size_t depth)
    {
        if (depth > kMaximumDepth) source_.fail(node, "items are nested more than 1000 deep; flatten the groups");
        if (!parent.isContainer() && itemTypeOf(catalog_, parent.type()))
            source_.fail(node,
                         "an item of type '" + parent.type() + "' cannot hold other items; move this one into a group");
        source_.onlyAttributes(node, {"type", "id", "name", "visible", "locked"});
        const std::string type(source_.required(node, "type"));
        const ItemId id = readId(node);
        const PropertyTable* table = itemTable(catalog_, type);
        if (!table) noteMissing(node, ContributionKind::ItemType, type);
        Item& item = builder_.add(parent, id, type);
        builder_.setName(item, std::string(source_.required(node, "name")));
        builder_.setFlags(item, source_.boolean(node, "visible", true), source_.boolean(node, "locked", false));
        Properties properties;
        for (const pugi::xml_node child : node.children()) {
            const std::string_view name = child.name();
            if (name == "path") {
                once(child, "<path>");
                readPath(child, item);
            } else if (name == "property") {
                setOnce(properties, child, readProperty(child, table, type));
            } else if (name == "effect") {
                readEffect(child, item);
            } else if (name == "instance") {
                once(child, "<instance>");
                if (node.child("item"))
                    source_.fail(child, "what is in an instance comes from its symbol; leave <item> out");
                readInstance(child, item, properties);
            } else if (name == "item") {
                readItem(child, item, depth + 1);
            } else {
                source_.unexpected(child, "an item holds <path>, <property>, <instance>, <effect> and <item>");
            }
        }
        builder_.setProperties(item, std::move(properties));
    }

    void readPath(const pugi::xml_node& node, Item& item)
    {
        source_.onlyAttributes(node, {});
        auto path = Path::parse(source_.textOf(node));
        if (!path) {
            Location where = source_.where(node.first_child() ? node.first_child() : node);
            where.column += std::max(0, path.error().where.column - 1);
            throw Failure(Error("the path of '" + item.name() + "': " + path.error().message, where));
        }
        builder_.setPath(item, std::move(*path));
    }

    void readEffect(const pugi::xml_node& node, Item& item)
    {
        source_.onlyAttributes(node, {"type", "visible"});
        EffectInstance effect;
        effect.type = source_.required(node, "type");
        effect.visible = source_.boolean(node, "visible", true);
        const Effect* known = catalog_.effect(effect.type);
        if (!known) noteMissing(node, ContributionKind::Effect, effect.type);
        for (const pugi::xml_node child : node.children()) {
            if (std::string_view(child.name()) != "property") {
                source_.unexpected(child, "an effect holds <property>");
                continue;
            }
            setOnce(effect.properties, child, readProperty(child, known ? &known->properties() : nullptr, effect.type));
        }
        builder_.addEffect(item, std::move(effect));
    }

    void noteMissing(const pugi::xml_node& node, ContributionKind kind, const std::string& id)
    {
        if (!noted_.insert(std::string(kindName(kind)) + id).second) return;
        notes_.push_back({catalog_.explain(kind, id) + " What it wrote is kept.", source_.where(node)});
    }

    XmlSource& source_;
    SceneBuilder builder_;
    Scene& scene_;
    Catalog& catalog_;
    std::vector<FormatNote>& notes_;
    std::set<std::string> noted_;
    std::vector<InstanceRecord> instances_;
};

/// What JET wrote itself is read without a document tree, several times as fast. Null where that is not so, or
/// something is wrong: then the thorough reader tells what.
std::unique_ptr<Scene> readOwnText(const std::string& text, const std::string& file, EventsCenter& events,
                                   Catalog& catalog, std::vector<FormatNote>& notes)
{
    const std::size_t items = itemsOf(text);
    if (items == std::string::npos) return nullptr;
    auto scene = std::make_unique<Scene>("", events, catalog);
    std::vector<FormatNote> remarks;
    try {
        XmlSource head(file, text.substr(0, items) + "</scene>\n");
        if (!head.parse()) return nullptr;
        SceneTextReader reader(head, *scene, catalog, remarks);
        reader.read();
        if (reader.version != kFormatVersion) return nullptr;
        if (!readItems(std::string_view(text).substr(items), *scene, reader.instances())) return nullptr;
        expandInstances(*scene, reader.instances());
    } catch (const Failure&) {
        return nullptr;
    }
    notes.insert(notes.end(), remarks.begin(), remarks.end());
    return scene;
}

}  // namespace

Result<std::unique_ptr<Scene>> readSceneText(std::string text, const std::string& file, EventsCenter& events,
                                             Catalog& catalog, std::vector<FormatNote>& notes, int& version)
{
    version = kFormatVersion;
    if (auto own = readOwnText(text, file, events, catalog, notes)) return own;
    XmlSource source(file, std::move(text));
    if (const auto parsed = source.parse(); !parsed) return parsed.error();
    auto scene = std::make_unique<Scene>("", events, catalog);
    try {
        SceneTextReader reader(source, *scene, catalog, notes);
        reader.read();
        version = reader.version;
        expandInstances(*scene, reader.instances());
    } catch (const Failure& failure) {
        return failure.error();
    }
    return scene;
}

Result<std::unique_ptr<Scene>> readSceneText(std::string text, const std::string& file, EventsCenter& events,
                                             Catalog& catalog, std::vector<FormatNote>& notes)
{
    int version = 0;
    return readSceneText(std::move(text), file, events, catalog, notes, version);
}

}  // namespace jet
