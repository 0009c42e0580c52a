#include "scene_fast_reader.hpp"

#include "scene_state.hpp"
#include "utf8.hpp"

#include <algorithm>
#include <charconv>
#include <deque>

namespace jet {

namespace {

/// What a type of items or effects declares, in the order files have it.
struct Declared {
    std::string type;
    std::vector<const PropertySpec*> sorted;
    bool container = false;
};

Declared declared(std::string_view type, const PropertyTable& table)
{
    Declared result{std::string(type), {}, type == GroupItem::type || type == LayerItem::type};
    for (const PropertySpec& spec : table.specs()) result.sorted.push_back(&spec);
    std::ranges::sort(result.sorted, {}, [](const PropertySpec* spec) { return std::string_view(spec->id); });
    return result;
}

/// A decimal number of at most 15 digits is the quotient of two doubles that are exact, and so is rounded once
/// (Clinger 1990); others, and what follows, are for std::from_chars. Returns the place after it, null if there is
/// none.
const char* readNumber(const char* at, const char* end, double& value)
{
    static constexpr double kPowers[] = {1,   1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                         1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
    const char* const begin = at;
    const bool negative = at != end && *at == '-';
    if (negative) ++at;
    std::uint64_t digits = 0;
    int count = 0, fraction = 0;
    const auto isDigit = [&] { return at != end && static_cast<unsigned char>(*at - '0') < 10; };
    for (; isDigit(); ++at, ++count) digits = digits * 10 + static_cast<std::uint64_t>(*at - '0');
    if (count == 0) return nullptr;
    if (at != end && *at == '.') {
        for (++at; isDigit(); ++at, ++fraction) digits = digits * 10 + static_cast<std::uint64_t>(*at - '0');
        if (fraction == 0) return nullptr;
    }
    if (count + fraction <= 15 && (at == end || *at != 'e')) {
        const double magnitude = static_cast<double>(digits) / kPowers[fraction];
        value = negative ? -magnitude : magnitude;
        return at;
    }
    const auto [stop, problem] = std::from_chars(begin, end, value);
    return problem == std::errc() ? stop : nullptr;
}

/// Path data as Path::text() writes it. None for other path data, be it right or wrong.
class PathText {
public:
    explicit PathText(std::string_view text) : at_(text.data()), end_(at_ + text.size()) {}

    bool read(Path& path)
    {
        std::vector<Contour> contours;
        segments_.clear();
        if (at_ == end_ || *at_ != 'M') return false;
        while (at_ != end_) {
            const char command = *at_++;
            if (command == 'n') return readCounts(contours) && finish(contours, path);
            if (command == 'M') {
                flush(contours, false);
                Vec2 p;
                if (!point(p)) return false;
                segments_.emplace_back(p);
            } else if (command == 'Z') {
                if (segments_.empty()) return false;
                close();
                flush(contours, true);
            } else if (!curve(command)) {
                return false;
            }
            if (at_ != end_ && *at_++ != ' ') return false;
        }
        return finish(contours, path);
    }

private:
    bool point(Vec2& p)
    {
        for (double* value : {&p.x(), &p.y()}) {
            if (at_ == end_ || *at_++ != ' ') return false;
            at_ = readNumber(at_, end_, *value);
            if (!at_) return false;
        }
        return true;
    }

    bool curve(char command)
    {
        if (segments_.empty()) return false;
        Vec2 p, out, in;
        if (command == 'L') {
            if (!point(p)) return false;
            segments_.back().out = segments_.back().point;
            segments_.emplace_back(p);
            return true;
        }
        if (command != 'C' || !point(out) || !point(in) || !point(p)) return false;
        segments_.back().out = out;
        segments_.emplace_back(p, in, p);
        return true;
    }

    /// As Path::close().
    void close()
    {
        if (segments_.size() > 1 && segments_.back().point == segments_.front().point) {
            segments_.front().in = segments_.back().in;
            segments_.pop_back();
        }
    }

    void flush(std::vector<Contour>& contours, bool closed)
    {
        if (segments_.empty()) return;
        Contour& contour = contours.emplace_back();
        contour.segments.assign(segments_.begin(), segments_.end());
        contour.closed = closed;
        segments_.clear();
    }

    bool readCounts(std::vector<Contour>& contours)
    {
        flush(contours, false);
        for (Contour& contour : contours)
            for (Segment& s : contour.segments) {
                if (at_ == end_ || *at_++ != ' ') return false;
                const auto [stop, problem] = std::from_chars(at_, end_, s.intermediate);
                if (problem != std::errc() || s.intermediate < 0 || s.intermediate > kMaxIntermediate) return false;
                at_ = stop;
            }
        return at_ == end_;
    }

    bool finish(std::vector<Contour>& contours, Path& path)
    {
        flush(contours, false);
        path = Path(std::move(contours));
        return true;
    }

    const char *at_, *end_;
    static thread_local std::vector<Segment> segments_;  // of the contour being read
};
thread_local std::vector<Segment> PathText::segments_;

class ItemsText {
public:
    ItemsText(std::string_view text, Scene& scene, std::vector<InstanceRecord>& instances)
        : rest_(text), scene_(scene), builder_(scene), instances_(instances)
    {
    }

    bool read()
    {
        while (line("<item type=\""))
            if (!item(builder_.root(), 1)) return false;
        return line("</scene>\n") && rest_.empty();
    }

private:
    // --- tokens

    bool skip(std::string_view expected)
    {
        if (!rest_.starts_with(expected)) return false;
        rest_.remove_prefix(expected.size());
        return true;
    }

    /// The same at the start of a line, whatever its indentation.
    bool line(std::string_view expected)
    {
        const std::size_t indent = std::min(rest_.find_first_not_of(' '), rest_.size());
        if (!rest_.substr(indent).starts_with(expected)) return false;
        rest_.remove_prefix(indent + expected.size());
        return true;
    }

    /// What stands before the next `stop`, which is skipped.
    bool upTo(char stop, std::string_view& text)
    {
        const std::size_t end = rest_.find(stop);
        if (end == std::string_view::npos) return false;
        text = rest_.substr(0, end);
        rest_.remove_prefix(end + 1);
        return true;
    }

    /// An attribute's or element's text with the references the writer makes put back; none with other ones.
    static bool unescaped(std::string_view text, std::string& out)
    {
        out.assign(text);
        if (text.find_first_of("&<>\t\n\"") == std::string_view::npos) return true;
        out.clear();
        while (!text.empty()) {
            const char c = text.front();
            if (c == '<' || c == '>' || c == '\t' || c == '\n' || c == '"') return false;
            if (c != '&') {
                out += c;
                text.remove_prefix(1);
                continue;
            }
            static constexpr std::pair<std::string_view, char> kReferences[] = {
                {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}};
            const auto* found =
                std::ranges::find_if(kReferences, [&](const auto& r) { return text.starts_with(r.first); });
            if (found == std::end(kReferences)) return false;
            out += found->second;
            text.remove_prefix(found->first.size());
        }
        return true;
    }

    // --- what is known

    template <class TableOf>
    const Declared* known(std::deque<Declared>& all, std::string_view type, TableOf tableOf)
    {
        for (const Declared& one : all)
            if (one.type == type) return &one;
        const PropertyTable* table = tableOf();
        if (!table) return nullptr;
        all.push_back(declared(type, *table));
        return &all.back();
    }

    const Declared* itemType(std::string_view type)
    {
        return known(types_, type, [&] { return itemTable(scene_.catalog(), type); });
    }

    const Declared* effectType(std::string_view type)
    {
        return known(effects_, type, [&]() -> const PropertyTable* {
            const Effect* effect = scene_.catalog().effect(type);
            return effect ? &effect->properties() : nullptr;
        });
    }

    // --- elements

    bool property(const Declared& owner, std::size_t& next, Properties& properties)
    {
        std::string_view id, text;
        if (!upTo('"', id) || !skip(">")) return false;
        while (next < owner.sorted.size() && owner.sorted[next]->id != id) ++next;
        if (next == owner.sorted.size()) return false;  // not declared, twice, or not in order
        const PropertySpec& spec = *owner.sorted[next++];
        if (skip("<![CDATA[")) {
            const std::size_t end = rest_.find("]]>");
            if (end == std::string_view::npos || spec.kind != ValueKind::Text) return false;
            properties.set(id, Value(rest_.substr(0, end)));
            rest_.remove_prefix(end + 3);
            return skip("</property>\n");
        }
        if (!upTo('<', text) || !skip("/property>\n")) return false;
        if (!unescaped(text, text_)) return false;
        auto value = Value::parse(spec.kind, text_);
        if (!value || !spec.check(*value)) return false;
        properties.set(id, std::move(*value));
        return true;
    }

    bool effect(Item& item)
    {
        std::string_view type;
        if (!upTo('"', type)) return false;
        const Declared* owner = effectType(type);
        if (!owner) return false;
        EffectInstance instance;
        instance.type = owner->type;
        instance.visible = !skip(" visible=\"false\"");
        if (!skip("/>\n")) {
            if (!skip(">\n")) return false;
            for (std::size_t next = 0; line("<property id=\"");)
                if (!property(*owner, next, instance.properties)) return false;
            if (!line("</effect>\n")) return false;
        }
        builder_.addEffect(item, std::move(instance));
        return true;
    }

    bool path(Item& item)
    {
        std::string_view text;
        if (!upTo('<', text) || !skip("/path>\n")) return false;
        Path path;
        if (!PathText(text).read(path)) {
            auto other = Path::parse(text);
            if (!other || text.find('&') != std::string_view::npos) return false;
            path = std::move(*other);
        }
        builder_.setPath(item, std::move(path));
        return true;
    }

    bool item(Item& parent, std::size_t depth)
    {
        std::string_view type, number, name;
        if (depth > kMaximumDepth || !upTo('"', type) || !skip(" id=\"") || !upTo('"', number)) return false;
        const Declared* owner = itemType(type);
        std::uint64_t id = 0;
        const auto [end, problem] = std::from_chars(number.data(), number.data() + number.size(), id);
        if (!owner || problem != std::errc() || end != number.data() + number.size()) return false;
        if (id == 0 || id > kMaximumId || scene_.items().find(ItemId{id})) return false;
        if (!skip(" name=\"") || !upTo('"', name) || !unescaped(name, text_)) return false;
        Item& added = builder_.add(parent, ItemId{id}, owner->type);
        builder_.setName(added, text_);
        const bool visible = !skip(" visible=\"false\"");
        const bool locked = skip(" locked=\"true\"");
        builder_.setFlags(added, visible, locked);
        if (skip("/>\n")) return true;
        return skip(">\n") && content(added, *owner, depth) && line("</item>\n");
    }

    bool content(Item& added, const Declared& owner, std::size_t depth)
    {
        if (line("<path>") && !path(added)) return false;
        Properties properties;
        for (std::size_t next = 0; line("<property id=\"");)
            if (!property(owner, next, properties)) return false;
        const bool linked = line("<instance symbol=\"");
        if (linked && !instance(added, properties)) return false;
        if (!properties.isEmpty()) builder_.setProperties(added, std::move(properties));
        while (line("<effect type=\""))
            if (!effect(added)) return false;
        while (line("<item type=\""))
            if (!owner.container || linked || !item(added, depth + 1)) return false;
        return true;
    }

    bool instance(const Item& added, Properties& properties)
    {
        std::string_view symbol, matrix, ids;
        if (!added.is<GroupItem>() || !upTo('"', symbol)) return false;
        if (skip(" matrix=\"") && !upTo('"', matrix)) return false;
        if (skip(" ids=\"") && !upTo('"', ids)) return false;
        const auto link = Value::parse(ValueKind::Item, symbol);
        const auto placement = matrix.empty() ? std::optional(Affine()) : parseMatrix(matrix);
        auto items = parseIds(ids);
        if (!skip("/>\n") || !link || !(*link).as<ItemId>() || !placement || !items) return false;
        properties.set(kLinkSymbol, *link);
        properties.set(kLinkX, Vec2(placement->linear().col(0)));
        properties.set(kLinkY, Vec2(placement->linear().col(1)));
        properties.set(kLinkOffset, Vec2(placement->matrix().col(2)));
        instances_.push_back({added.id(), std::move(*items), {}});
        return true;
    }

    std::string_view rest_;
    Scene& scene_;
    SceneBuilder builder_;
    std::vector<InstanceRecord>& instances_;
    std::deque<Declared> types_, effects_;  // deques: what was handed out stays where it is
    std::string text_;
};

}  // namespace

std::size_t itemsOf(std::string_view text)
{
    constexpr std::string_view kBegin = "\n  <item type=\"";
    if (!text.ends_with("</scene>\n")) return std::string_view::npos;
    const std::size_t found = text.find(kBegin);
    return found == std::string_view::npos ? found : found + 1;
}

bool readItems(std::string_view text, Scene& scene, std::vector<InstanceRecord>& instances)
{
    // The thorough reader makes line ends of '\r'.
    if (text.find('\r') != std::string_view::npos || firstUnstorable(text) != std::string_view::npos) return false;
    return ItemsText(text, scene, instances).read();
}

}  // namespace jet
