#include "journal_bytes.hpp"

#include "utf8.hpp"

#include <cmath>

namespace jet {

namespace {

/// What a value holds, as the number its bytes start with. Journals on disk know these numbers: add, never change.
enum class ValueTag : std::uint8_t { None, Bool, Integer, Real, Vec2, Color, Text, Item, Path, Raw };
static_assert(std::variant_size_v<Value::Content> == 10, "a new kind of value needs a tag, written and read below");

struct ValueWriter {
    ByteWriter& out;
    void tag(ValueTag t) const { out.byte(static_cast<std::uint8_t>(t)); }
    void operator()(std::monostate) const { tag(ValueTag::None); }
    void operator()(bool b) const { tag(ValueTag::Bool), out.byte(b ? 1 : 0); }
    void operator()(std::int64_t n) const { tag(ValueTag::Integer), out.bits(static_cast<std::uint64_t>(n)); }
    void operator()(double d) const { tag(ValueTag::Real), out.real(d); }
    void operator()(const Vec2& v) const { tag(ValueTag::Vec2), out.point(v); }
    void operator()(const Color& c) const
    {
        tag(ValueTag::Color);
        for (const std::uint8_t channel : {c.r, c.g, c.b, c.a}) out.byte(channel);
    }
    void operator()(const std::string& s) const { tag(ValueTag::Text), out.text(s); }
    void operator()(const ItemId& id) const { tag(ValueTag::Item), out.number(id.value); }
    void operator()(const Path& p) const { tag(ValueTag::Path), out.path(p); }
    void operator()(const RawText& raw) const { tag(ValueTag::Raw), out.text(raw.text); }
};

constexpr std::size_t kSegmentBytes = 6 * 8 + 1;

}  // namespace

void ByteWriter::path(const Path& path)
{
    number(path.contours().size());
    for (const Contour& contour : path.contours()) {
        number(contour.segments.size() * 2 + (contour.closed ? 1 : 0));
        for (const Segment& s : contour.segments) {
            point(s.point), point(s.in), point(s.out);
            number(static_cast<std::uint64_t>(s.intermediate));
        }
    }
}

void ByteWriter::value(const Value& value) { std::visit(ValueWriter{*this}, value.content()); }

void ByteWriter::properties(const Properties& properties)
{
    number(properties.entries().size());
    for (const auto& [id, v] : properties.entries()) text(id), value(v);
}

void ByteWriter::effect(const EffectInstance& effect)
{
    text(effect.type);
    byte(effect.visible ? 1 : 0);
    properties(effect.properties);
}

void ByteWriter::materials(const MaterialTable& table)
{
    number(table.size());
    for (const std::string& name : table.names()) text(name);
    for (std::size_t a = 0; a < table.size(); ++a)
        for (std::size_t b = a; b < table.size(); ++b) {
            const MaterialPair& pair = table.pair(a, b);
            real(pair.friction), real(pair.restitution), byte(pair.collides ? 1 : 0);
        }
}

void ByteWriter::item(const Item& item)
{
    number(item.id().value);
    text(item.type()), text(item.name());
    byte(static_cast<std::uint8_t>((item.visible() ? 1 : 0) + (item.locked() ? 2 : 0)));
    path(item.path());
    properties(item.properties());
    number(item.effects().size());
    for (const EffectInstance& e : item.effects()) effect(e);
}

void ByteReader::fail(const char* what) { throw Failure(Error(std::string("the journal is damaged: ") + what)); }

std::uint8_t ByteReader::byte()
{
    if (rest_.empty()) fail("a record ends too early");
    const auto b = static_cast<std::uint8_t>(rest_.front());
    rest_.remove_prefix(1);
    return b;
}

std::uint64_t ByteReader::number()
{
    std::uint64_t n = 0;
    for (int shift = 0; shift < 64; shift += 7) {
        const std::uint8_t b = byte();
        n |= static_cast<std::uint64_t>(b & 0x7f) << shift;
        if (b < 0x80) return n;
    }
    fail("a number has no end");
}

std::uint64_t ByteReader::bits()
{
    std::uint64_t n = 0;
    for (int i = 0; i < 8; ++i) n |= static_cast<std::uint64_t>(byte()) << (8 * i);
    return n;
}

std::size_t ByteReader::count(std::size_t least)
{
    const std::uint64_t n = number();
    if (n > rest_.size() / least) fail("it counts more than it holds");
    return static_cast<std::size_t>(n);
}

double ByteReader::real()
{
    const double d = std::bit_cast<double>(bits());
    if (!std::isfinite(d)) fail("a number in it is not finite");
    return d;
}

Vec2 ByteReader::point()
{
    const double x = real(), y = real();
    return {x, y};
}

std::string_view ByteReader::text()
{
    const std::size_t size = count();
    const std::string_view s = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return s;
}

std::string ByteReader::storable()
{
    const std::string_view s = text();
    if (firstUnstorable(s) != std::string_view::npos) fail("a text in it is not UTF-8");
    return std::string(s);
}

bool ByteReader::flag()
{
    const std::uint8_t b = byte();
    if (b > 1) fail("a flag is neither 0 nor 1");
    return b == 1;
}

Path ByteReader::path()
{
    std::vector<Contour> contours(count());
    for (Contour& contour : contours) {
        const std::uint64_t packed = number();
        if (packed / 2 > rest_.size() / kSegmentBytes) fail("a path counts more segments than it holds");
        contour.closed = packed % 2 == 1;
        contour.segments.resize(static_cast<std::size_t>(packed / 2));
        for (Segment& s : contour.segments) {
            s.point = point(), s.in = point(), s.out = point();
            const std::uint64_t intermediate = number();
            if (intermediate > kMaxIntermediate) fail("a segment has too many intermediate points");
            s.intermediate = static_cast<int>(intermediate);
        }
    }
    return Path(std::move(contours));
}

Value ByteReader::value()
{
    switch (static_cast<ValueTag>(byte())) {
    case ValueTag::None: return {};
    case ValueTag::Bool: return flag();
    case ValueTag::Integer: return static_cast<std::int64_t>(bits());
    case ValueTag::Real: return real();
    case ValueTag::Vec2: return point();
    case ValueTag::Color: {
        Color c;
        c.r = byte(), c.g = byte(), c.b = byte(), c.a = byte();
        return c;
    }
    case ValueTag::Text: return storable();
    case ValueTag::Item: return ItemId{number()};
    case ValueTag::Path: return path();
    case ValueTag::Raw: return RawText{storable()};
    }
    fail("it holds a kind of value this JET does not know; open it with a newer JET");
}

Properties ByteReader::properties()
{
    Properties result;
    for (std::size_t n = count(2); n > 0; --n) {
        std::string id = storable();
        result.set(id, value());
    }
    return result;
}

EffectInstance ByteReader::effect()
{
    EffectInstance result;
    result.type = storable();
    result.visible = flag();
    result.properties = properties();
    return result;
}

MaterialTable ByteReader::materials()
{
    const std::size_t size = count();
    if (size == 0) fail("a table of materials is empty");
    if (size > 0xffff || size * (size + 1) / 2 > rest_.size() / 17)
        fail("a table of materials counts more than it holds");
    MaterialTable table(storable());
    for (std::size_t i = 1; i < size; ++i) {
        const std::string name = storable();
        if (table.find(name) >= 0) fail("a material stands in it twice");
        table.add(name);
    }
    for (std::size_t a = 0; a < size; ++a)
        for (std::size_t b = a; b < size; ++b) {
            MaterialPair pair;
            pair.friction = real(), pair.restitution = real(), pair.collides = flag();
            table.setPair(a, b, pair);
        }
    return table;
}

std::unique_ptr<Item> ByteReader::item()
{
    const ItemId id{number()};
    if (!id || id.value > kMaximumId) fail("an item has a number out of range");
    auto item = std::make_unique<Item>(id, storable());
    Item::Mutator::setName(*item, storable());
    const std::uint8_t flags = byte();
    if (flags > 3) fail("an item has flags that are not known");
    Item::Mutator::setFlags(*item, (flags & 1) != 0, (flags & 2) != 0);
    Item::Mutator::setPath(*item, path());
    Item::Mutator::setProperties(*item, properties());
    for (std::size_t n = count(); n > 0; --n) Item::Mutator::effects(*item).push_back(effect());
    return item;
}

}  // namespace jet
