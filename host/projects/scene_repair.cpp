#include "scene_repair.hpp"

#include <jet/effect.hpp>
#include <jet/item_type.hpp>
#include <jet/scene.hpp>

#include <algorithm>
#include <charconv>
#include <set>

namespace jet::host {

namespace {

constexpr std::uint64_t kLargestId = (std::uint64_t{1} << 53) - 1;

bool isOneOf(std::string_view word, std::initializer_list<std::string_view> words)
{
    return std::ranges::find(words, word) != words.end();
}

/// The id an attribute tells; 0 where it is none.
std::uint64_t idOf(const pugi::xml_attribute& attribute)
{
    const std::string_view text = attribute.value();
    std::uint64_t id = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), id);
    return problem == std::errc() && end == text.data() + text.size() && id <= kLargestId ? id : 0;
}

std::string inQuotes(std::string_view text) { return "'" + std::string(text.substr(0, 60)) + "'"; }

class Mender {
public:
    Mender(XmlFile& scene, Catalog& catalog) : scene_(scene), catalog_(catalog) {}

    Findings run()
    {
        const pugi::xml_node root = scene_.root();
        if (std::string_view(root.name()) != "scene") return std::move(found_);  // the reader tells
        forItems(root, [this](pugi::xml_node item) {
            if (const std::uint64_t id = idOf(item.attribute("id")); id != 0) all_.insert(id);
        });
        largest_ = all_.empty() ? 0 : *all_.rbegin();
        keepOnly(root, {"settings", "materials", "item"}, "a scene");
        once(root, "settings"), once(root, "materials");
        if (const auto settings = root.child("settings")) mendProperties(settings, &Scene::settingsTable());
        forItems(root, [this](pugi::xml_node item) { mendItem(item); });
        return std::move(found_);
    }

private:
    /// From the top down, without recursion. `visit` may change what is in the item, not where it is.
    template <class Visit>
    static void forItems(pugi::xml_node root, Visit visit)
    {
        pugi::xml_node at = root.child("item");
        while (at) {
            visit(at);
            pugi::xml_node next = at.child("item");
            while (!next && at != root) {
                next = at.next_sibling("item");
                if (!next) at = at.parent();
            }
            at = next;
        }
    }

    void tell(const pugi::xml_node& node, std::string problem, std::string repair)
    {
        found_.push_back({Finding::Weight::Error, scene_.where(node), std::move(problem), std::move(repair), false});
    }

    void mendItem(pugi::xml_node item)
    {
        onlyAttributes(item, {"type", "id", "name", "visible", "locked"});
        mendId(item);
        if (!item.attribute("type")) {
            const char* type = item.child("path") ? "shape" : "group";
            tell(item, "an item has no type", std::string("it becomes a ") + type);
            item.append_attribute("type") = type;
        }
        if (!item.attribute("name")) {
            tell(item, "an item has no name", "it gets an empty one");
            item.append_attribute("name") = "";
        }
        mendFlag(item, "visible"), mendFlag(item, "locked");
        keepOnly(item, {"path", "property", "effect", "item"}, "an item");
        once(item, "path");
        if (const auto path = item.child("path")) mendPath(path);
        const std::string type = item.attribute("type").value();
        const ItemType* known = builtInItemType(type) ? builtInItemType(type) : catalog_.itemType(type);
        mendProperties(item, known ? &known->properties() : nullptr);
        for (pugi::xml_node effect = item.child("effect"); effect;) {
            const pugi::xml_node next = effect.next_sibling("effect");
            mendEffect(item, effect);
            effect = next;
        }
    }

    void mendEffect(pugi::xml_node item, pugi::xml_node effect)
    {
        if (!effect.attribute("type")) {
            tell(effect, "an effect has no type", "it is left out");
            item.remove_child(effect);
            return;
        }
        onlyAttributes(effect, {"type", "visible"});
        mendFlag(effect, "visible");
        keepOnly(effect, {"property"}, "an effect");
        const Effect* known = catalog_.effect(effect.attribute("type").value());
        mendProperties(effect, known ? &known->properties() : nullptr);
    }

    void mendId(pugi::xml_node item)
    {
        pugi::xml_attribute attribute = item.attribute("id");
        const std::uint64_t id = idOf(attribute);
        if (id != 0 && taken_.insert(id).second) return;
        std::uint64_t free = largest_ < kLargestId ? ++largest_ : 1;
        while (all_.contains(free) || taken_.contains(free)) ++free;
        const std::string problem = !attribute ? "an item has no id"
                                    : id == 0  ? "the id " + inQuotes(attribute.value()) + " is none"
                                               : "there is another item with the id " + std::to_string(id);
        tell(item, problem, "it gets the id " + std::to_string(free));
        if (!attribute) attribute = item.append_attribute("id");
        attribute.set_value(static_cast<unsigned long long>(free));
        taken_.insert(free);
    }

    void mendFlag(pugi::xml_node node, const char* name)
    {
        const pugi::xml_attribute attribute = node.attribute(name);
        if (!attribute || isOneOf(attribute.value(), {"true", "false"})) return;
        tell(node, std::string(name) + "=" + inQuotes(attribute.value()) + " is neither true nor false",
             "it is left out");
        node.remove_attribute(attribute);
    }

    void onlyAttributes(pugi::xml_node node, std::initializer_list<std::string_view> known)
    {
        for (pugi::xml_attribute at = node.first_attribute(); at;) {
            const pugi::xml_attribute next = at.next_attribute();
            if (!isOneOf(at.name(), known)) {
                tell(node, "<" + std::string(node.name()) + "> has no attribute " + inQuotes(at.name()),
                     "it is left out");
                node.remove_attribute(at);
            }
            at = next;
        }
    }

    void keepOnly(pugi::xml_node node, std::initializer_list<std::string_view> known, const char* what)
    {
        for (pugi::xml_node at = node.first_child(); at;) {
            const pugi::xml_node next = at.next_sibling();
            const bool isBlank = std::string_view(at.value()).find_first_not_of(" \t\r\n") == std::string_view::npos;
            const bool isElement = at.type() == pugi::node_element;
            const bool isText = at.type() == pugi::node_pcdata || at.type() == pugi::node_cdata;
            if (isElement ? !isOneOf(at.name(), known) : isText && !isBlank) {
                tell(at, std::string(what) + " holds no " + (isElement ? "<" + std::string(at.name()) + ">" : "text"),
                     "it is left out");
                node.remove_child(at);
            }
            at = next;
        }
    }

    void once(pugi::xml_node node, const char* name)
    {
        const pugi::xml_node first = node.child(name);
        while (const pugi::xml_node second = first.next_sibling(name)) {
            tell(second, "<" + std::string(name) + "> stands here twice", "the first one stays");
            node.remove_child(second);
        }
    }

    void mendPath(pugi::xml_node path)
    {
        const std::string text = path.text().get();
        const auto parsed = Path::parse(text);
        if (parsed) return;
        const std::string owner = inQuotes(path.parent().attribute("name").value());
        std::string mended;
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = std::min(text.find_first_of(" ,\t\r\n", at), text.size());
            const std::string_view word = std::string_view(text).substr(at, end - at);
            mended += isFinite(word) ? word : "0";
            if (end < text.size()) mended += text[end];
            at = end + 1;
        }
        if (Path::parse(mended)) {
            tell(path, "the path of " + owner + ": a coordinate is not finite", "it becomes 0");
            path.text().set(mended.c_str());
        } else {
            tell(path, "the path of " + owner + ": " + parsed.error().message, "it is left out");
            path.parent().remove_child(path);
        }
    }

    // "nan", "-inf", "1e999"; commands and other words are none of our business.
    static bool isFinite(std::string_view word)
    {
        while (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
        if (word.starts_with("nan") || word.starts_with("NaN") || word.starts_with("inf") || word.starts_with("Inf"))
            return false;
        double value = 0;
        const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
        return problem != std::errc::result_out_of_range;
    }

    void mendProperties(pugi::xml_node node, const PropertyTable* table)
    {
        std::set<std::string> ids;
        for (pugi::xml_node at = node.child("property"); at;) {
            const pugi::xml_node next = at.next_sibling("property");
            const std::string id = at.attribute("id").value();
            if (!at.attribute("id")) {
                tell(at, "a property has no id", "it is left out");
                node.remove_child(at);
            } else if (!ids.insert(id).second) {
                tell(at, "the property " + inQuotes(id) + " stands here twice", "the first one stays");
                node.remove_child(at);
            } else if (const PropertySpec* spec = table ? table->find(id) : nullptr) {
                mendValue(node, at, *spec);
            }
            at = next;
        }
    }

    void mendValue(pugi::xml_node owner, pugi::xml_node node, const PropertySpec& spec)
    {
        const std::string text = node.text().get();
        const auto value = Value::parse(spec.kind, text);
        const std::string property = "the property " + inQuotes(spec.id) + " ";
        if (!value) {
            tell(node, property + "is " + inQuotes(text) + ": " + value.error().message, "it gets its default");
            owner.remove_child(node);
        } else if (const auto fine = spec.check(*value); !fine) {
            const bool isNumber = spec.kind == ValueKind::Real || spec.kind == ValueKind::Integer;
            const auto limited =
                isNumber ? Value::parse(spec.kind, nearest(spec, *value)) : Value::parse(spec.kind, "?");
            const bool canLimit = limited && spec.check(*limited);
            tell(node, property + "is " + inQuotes(text) + ": " + fine.error().message,
                 canLimit ? "it becomes " + limited->text() : "it gets its default");
            if (canLimit) {
                node.text().set(limited->text().c_str());
            } else {
                owner.remove_child(node);
            }
        } else if (spec.kind == ValueKind::Item && *value != Value(ItemId{})) {
            if (const auto id = std::strtoull(text.c_str(), nullptr, 10); all_.contains(id)) return;
            tell(node, property + "refers to the item " + text + ", which is not there", "it refers to none");
            owner.remove_child(node);
        }
    }

    static std::string nearest(const PropertySpec& spec, const Value& value)
    {
        if (spec.kind == ValueKind::Integer)
            return std::to_string(static_cast<std::int64_t>(
                std::clamp(static_cast<double>(value.as<std::int64_t>()), spec.minimum, spec.maximum)));
        return Value(std::clamp(value.as<double>(), spec.minimum, spec.maximum)).text();
    }

    XmlFile& scene_;
    Catalog& catalog_;
    Findings found_;
    std::set<std::uint64_t> all_, taken_;
    std::uint64_t largest_ = 0;
};

}  // namespace

Findings mendScene(XmlFile& scene, Catalog& catalog) { return Mender(scene, catalog).run(); }

}  // namespace jet::host
