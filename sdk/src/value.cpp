// Values of properties: kinds, bit-wise equality, and their text.
#include <jet/value.hpp>

#include "bits.hpp"

#include <charconv>
#include <type_traits>

namespace jet {

// --- numbers

std::string numberText(double value)
{
    std::string text;
    appendNumber(text, value);
    return text;
}

void appendNumber(std::string& out, double value)
{
    char buffer[40];
    char* const end = buffer + sizeof buffer;
    const double magnitude = std::abs(value);
    const bool plain = magnitude >= 1e-5 && magnitude < 1e15;  // a person reads 100000 more easily than 1e+05
    std::to_chars_result result{};
    if (plain && value == std::trunc(value))
        result = std::to_chars(buffer, end, static_cast<std::int64_t>(value));  // several times faster
    else if (plain)
        result = std::to_chars(buffer, end, value, std::chars_format::fixed);
    else
        result = std::to_chars(buffer, end, value);
    out.append(buffer, result.ptr);
}

namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// Of a number that no double holds: is it too small (and not too large)?
bool underflows(std::string_view digits)
{
    const std::size_t exponent = digits.find_first_of("eE");
    if (exponent != digits.npos) return digits[exponent + 1] == '-';
    return digits.front() == '.' || digits.front() == '0';
}

}  // namespace

bool readNumber(std::string_view& text, double& value)
{
    const char* begin = text.data();
    const char* const end = begin + text.size();
    const bool negative = begin != end && *begin == '-';
    if (begin != end && (*begin == '-' || *begin == '+')) ++begin;
    const bool starts = begin != end && (isDigit(*begin) || (*begin == '.' && begin + 1 != end && isDigit(begin[1])));
    if (!starts) return false;  // from_chars would read "inf" and "nan"

    double magnitude = 0;
    const auto [stop, problem] = std::from_chars(begin, end, magnitude);
    if (problem == std::errc::result_out_of_range) {
        if (!underflows({begin, stop})) return false;
        magnitude = 0;
    }
    value = negative ? -magnitude : magnitude;
    text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
    return true;
}

// --- kinds

std::string_view kindName(ValueKind kind)
{
    switch (kind) {
    case ValueKind::None: return "no value";
    case ValueKind::Bool: return "true or false";
    case ValueKind::Integer: return "an integer";
    case ValueKind::Real: return "a real number";
    case ValueKind::Vec2: return "a vector";
    case ValueKind::Color: return "a colour";
    case ValueKind::Text: return "a text";
    case ValueKind::Choice: return "a choice";
    case ValueKind::Item: return "an item";
    case ValueKind::Path: return "a path";
    case ValueKind::Raw: return "a text of unknown kind";
    }
    return "an unknown kind";
}

ValueKind Value::kind() const
{
    constexpr std::array kinds{ValueKind::None,  ValueKind::Bool, ValueKind::Integer, ValueKind::Real, ValueKind::Vec2,
                               ValueKind::Color, ValueKind::Text, ValueKind::Item,    ValueKind::Path, ValueKind::Raw};
    static_assert(kinds.size() == std::variant_size_v<Content>);
    return kinds[content_.index()];
}

namespace {

template <class T>
const T& contentAs(const Value& value, ValueKind wanted)
{
    if (const T* content = value.get<T>()) return *content;
    throw Failure(Error("Expected " + std::string(kindName(wanted)) + ", but the value is " +
                        std::string(kindName(value.kind())) + "."));
}

}  // namespace

template <>
bool Value::as<bool>() const
{
    return contentAs<bool>(*this, ValueKind::Bool);
}

template <>
std::int64_t Value::as<std::int64_t>() const
{
    return contentAs<std::int64_t>(*this, ValueKind::Integer);
}

template <>
int Value::as<int>() const
{
    const auto value = as<std::int64_t>();
    if (!std::in_range<int>(value))
        throw Failure(Error("The integer " + std::to_string(value) + " has too many digits."));
    return static_cast<int>(value);
}

template <>
double Value::as<double>() const
{
    if (const auto* integer = get<std::int64_t>()) return static_cast<double>(*integer);
    return contentAs<double>(*this, ValueKind::Real);
}

template <>
Vec2 Value::as<Vec2>() const
{
    return contentAs<Vec2>(*this, ValueKind::Vec2);
}

template <>
Color Value::as<Color>() const
{
    return contentAs<Color>(*this, ValueKind::Color);
}

template <>
std::string Value::as<std::string>() const
{
    return contentAs<std::string>(*this, ValueKind::Text);
}

template <>
ItemId Value::as<ItemId>() const
{
    return contentAs<ItemId>(*this, ValueKind::Item);
}

template <>
Path Value::as<Path>() const
{
    return contentAs<Path>(*this, ValueKind::Path);
}

bool Value::operator==(const Value& other) const
{
    if (content_.index() != other.content_.index()) return false;
    const auto equal = [&]<class T>(const T& mine) {
        const T& theirs = *other.get<T>();
        if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Vec2> || std::is_same_v<T, Path>)
            return sameBits(mine, theirs);
        else
            return mine == theirs;
    };
    return std::visit(equal, content_);
}

// --- text

namespace {

struct ToText {
    std::string operator()(std::monostate) const { return {}; }
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(std::int64_t v) const { return std::to_string(v); }
    std::string operator()(double v) const { return numberText(v); }
    std::string operator()(const Vec2& v) const { return numberText(v.x()) + ' ' + numberText(v.y()); }
    std::string operator()(Color v) const { return v.text(); }
    std::string operator()(const std::string& v) const { return v; }
    std::string operator()(ItemId v) const { return std::to_string(v.value); }
    std::string operator()(const Path& v) const { return v.text(); }
    std::string operator()(const RawText& v) const { return v.text; }
};

Error expected(std::string_view what, std::string_view text)
{
    return Error("Expected " + std::string(what) + ", but found \"" + std::string(text.substr(0, 60)) +
                 (text.size() > 60 ? "…\"." : "\"."));
}

template <class Integer>
bool readWhole(std::string_view text, Integer& value)
{
    const char* const end = text.data() + text.size();
    const auto [stop, problem] = std::from_chars(text.data(), end, value);
    return problem == std::errc() && stop == end;
}

Result<Value> parseBool(std::string_view text)
{
    if (text == "true") return Value(true);
    if (text == "false") return Value(false);
    return expected("true or false", text);
}

Result<Value> parseInteger(std::string_view text)
{
    std::int64_t value = 0;
    if (readWhole(text, value)) return Value(value);
    return expected("an integer such as 12 or -3, of at most 18 digits", text);
}

Result<Value> parseReal(std::string_view text)
{
    double value = 0;
    std::string_view rest = text;
    if (readNumber(rest, value) && rest.empty()) return Value(value);
    return expected("a number such as 12, -0.5 or 1e-3, of size below 1.8e308", text);
}

Result<Value> parseVector(std::string_view text)
{
    Vec2 value;
    std::string_view rest = text;
    const auto separator = [&] {
        const std::size_t count = std::min(rest.find_first_not_of(' '), rest.size());
        rest.remove_prefix(count);
        return count > 0;
    };
    if (readNumber(rest, value.x()) && separator() && readNumber(rest, value.y()) && rest.empty()) return Value(value);
    return expected("two numbers separated by a space, such as 10 -2.5", text);
}

Result<Value> parseItem(std::string_view text)
{
    ItemId id;
    if (readWhole(text, id.value)) return Value(id);
    return expected("the number of an item such as 12, or 0 for none", text);
}

/// Result<T> as Result<Value>.
template <class T>
Result<Value> wrapped(Result<T> result)
{
    if (!result) return result.error();
    return Value(*std::move(result));
}

}  // namespace

std::string Value::text() const { return std::visit(ToText{}, content_); }

Result<Value> Value::parse(ValueKind kind, std::string_view text)
{
    switch (kind) {
    case ValueKind::None:
        if (text.empty()) return Value();
        return expected("no value", text);
    case ValueKind::Bool: return parseBool(text);
    case ValueKind::Integer: return parseInteger(text);
    case ValueKind::Real: return parseReal(text);
    case ValueKind::Vec2: return parseVector(text);
    case ValueKind::Color: return wrapped(Color::parse(text));
    case ValueKind::Text:
    case ValueKind::Choice: return Value(text);
    case ValueKind::Item: return parseItem(text);
    case ValueKind::Path: return wrapped(Path::parse(text));
    case ValueKind::Raw: return Value(RawText{std::string(text)});
    }
    return Error("This kind of value is not known to this version of JET.");
}

}  // namespace jet
