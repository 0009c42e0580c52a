// Declared properties: what a value must be to be accepted, and the values of one item or effect, sorted by id.
#include <jet/property.hpp>

#include <algorithm>

namespace jet {

namespace {

bool isKind(const Value& value, ValueKind kind)
{
    const ValueKind has = value.kind();
    if (kind == ValueKind::Real)
        return has == ValueKind::Real || has == ValueKind::Integer;  // an integer reads as a real
    if (kind == ValueKind::Choice) return has == ValueKind::Text;
    return has == kind;
}

bool isFiniteValue(const Value& value)
{
    if (const auto* real = value.get<double>()) return std::isfinite(*real);
    if (const auto* vector = value.get<Vec2>()) return isFinite(*vector);
    if (const auto* path = value.get<Path>()) return path->isFinite();
    return true;
}

bool isInRange(const Value& value, double lo, double hi)
{
    const auto within = [lo, hi](double v) { return v >= lo && v <= hi; };
    if (const auto* vector = value.get<Vec2>()) return within(vector->x()) && within(vector->y());
    if (value.get<double>() || value.get<std::int64_t>()) return within(value.as<double>());
    return true;
}

std::string rangeText(double lo, double hi)
{
    if (lo == -std::numeric_limits<double>::infinity()) return "at most " + numberText(hi);
    if (hi == std::numeric_limits<double>::infinity()) return "at least " + numberText(lo);
    return "from " + numberText(lo) + " to " + numberText(hi);
}

std::string listText(const std::vector<std::string>& words)
{
    std::string list;
    for (const std::string& word : words) list += (list.empty() ? "" : ", ") + word;
    return list;
}

/// The value as a message shows it: with its unit, and not pages of it.
std::string shown(const Value& value, const std::string& unit)
{
    std::string text = value.text();
    if (text.size() > 60) {
        text.resize(60);
        text += "…";
    }
    const ValueKind kind = value.kind();
    if (kind == ValueKind::Text || kind == ValueKind::Raw) return '"' + text + '"';
    return unit.empty() || text.empty() ? text : text + ' ' + unit;
}

}  // namespace

Result<void> PropertySpec::check(const Value& value) const
{
    const auto fail = [&](const std::string& must, const std::string& has) {
        return Error("Property \"" + id + "\" must be " + must + ", but " + has + ".");
    };
    if (!isKind(value, kind)) {
        std::string has(kindName(value.kind()));
        if (!value.isNone()) has += ", " + shown(value, "");
        return fail(std::string(kindName(kind)), "has " + has);
    }
    if (!isFiniteValue(value)) return fail("finite", "is " + shown(value, unit));
    if (!isInRange(value, minimum, maximum))
        return fail(rangeText(minimum, maximum) + (unit.empty() ? "" : ' ' + unit), "is " + shown(value, unit));
    if (kind == ValueKind::Choice && std::ranges::find(choices, *value.get<std::string>()) == choices.end())
        return fail("one of " + listText(choices), "is " + shown(value, ""));
    return {};
}

const PropertySpec* PropertyTable::find(std::string_view id) const
{
    const auto spec = std::ranges::find(specs_, id, &PropertySpec::id);
    return spec == specs_.end() ? nullptr : &*spec;
}

namespace {

PropertySpec declare(std::string id, std::string label, ValueKind kind, Value fallback)
{
    PropertySpec spec;
    spec.id = std::move(id);
    spec.label = std::move(label);
    spec.kind = kind;
    spec.fallback = std::move(fallback);
    return spec;
}

}  // namespace

PropertySpec flag(std::string id, std::string label, bool fallback)
{
    return declare(std::move(id), std::move(label), ValueKind::Bool, fallback);
}

PropertySpec integer(std::string id, std::string label, std::int64_t fallback)
{
    return declare(std::move(id), std::move(label), ValueKind::Integer, fallback);
}

PropertySpec real(std::string id, std::string label, double fallback)
{
    return declare(std::move(id), std::move(label), ValueKind::Real, fallback);
}

PropertySpec vector(std::string id, std::string label, Vec2 fallback)
{
    return declare(std::move(id), std::move(label), ValueKind::Vec2, fallback);
}

PropertySpec color(std::string id, std::string label, Color fallback)
{
    return declare(std::move(id), std::move(label), ValueKind::Color, fallback);
}

PropertySpec text(std::string id, std::string label, std::string fallback, bool multiline)
{
    PropertySpec spec = declare(std::move(id), std::move(label), ValueKind::Text, std::move(fallback));
    spec.multiline = multiline;
    return spec;
}

PropertySpec choice(std::string id, std::string label, std::vector<std::string> choices)
{
    Value first = choices.empty() ? Value("") : Value(choices.front());
    PropertySpec spec = declare(std::move(id), std::move(label), ValueKind::Choice, std::move(first));
    spec.choices = std::move(choices);
    return spec;
}

Properties::Properties(std::initializer_list<Entry> entries)
{
    for (const Entry& entry : entries) set(entry.first, entry.second);
}

const Value* Properties::find(std::string_view id) const
{
    const auto entry = std::ranges::lower_bound(entries_, id, {}, &Entry::first);
    return entry != entries_.end() && entry->first == id ? &entry->second : nullptr;
}

const Value& Properties::get(std::string_view id, const PropertyTable& table) const
{
    if (const Value* value = find(id)) return *value;
    if (const PropertySpec* spec = table.find(id)) return spec->fallback;
    throw Failure(Error("There is no property \"" + std::string(id) + "\" here."));
}

void Properties::set(std::string_view id, Value value)
{
    const auto entry = std::ranges::lower_bound(entries_, id, {}, &Entry::first);
    if (entry != entries_.end() && entry->first == id)
        entry->second = std::move(value);
    else
        entries_.emplace(entry, std::string(id), std::move(value));
}

bool Properties::erase(std::string_view id)
{
    const auto entry = std::ranges::lower_bound(entries_, id, {}, &Entry::first);
    if (entry == entries_.end() || entry->first != id) return false;
    entries_.erase(entry);
    return true;
}

}  // namespace jet
