// The values properties hold. A Value is plain data: undo steps and files store it without the plugin that made it.
#pragma once

#include <jet/geometry.hpp>
#include <jet/path.hpp>
#include <jet/result.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

namespace jet {

/// Identifies an item within its scene for as long as the scene lives, in files and in undo. 0 is "none".
struct ItemId {
    std::uint64_t value = 0;
    explicit operator bool() const { return value != 0; }
    auto operator<=>(const ItemId&) const = default;
};

/// Colour, not premultiplied, sRGB.
struct Color {
    std::uint8_t r = 0, g = 0, b = 0, a = 255;
    bool operator==(const Color&) const = default;

    /// `#rrggbb`, or `#rrggbbaa` where not opaque.
    JET_API std::string text() const;
    /// `#rgb`, `#rrggbb`, `#rrggbbaa` or one of the 147 SVG colour names.
    JET_API static Result<Color> parse(std::string_view text);
};

/// Text of a property whose kind is not known here (its plugin is absent): written back as it was read.
struct RawText {
    std::string text;
    bool operator==(const RawText&) const = default;
};

enum class ValueKind { None, Bool, Integer, Real, Vec2, Color, Text, Choice, Item, Path, Raw };

/// The kind as a message names it, with its article: "a real number".
JET_API std::string_view kindName(ValueKind kind);

/// Choice values are stored as text: the id of the choice.
class JET_API Value {
public:
    Value() = default;
    Value(bool v) : content_(v) {}
    Value(int v) : content_(static_cast<std::int64_t>(v)) {}
    Value(std::int64_t v) : content_(v) {}
    Value(double v) : content_(v) {}
    Value(const Vec2& v) : content_(v) {}
    Value(Color v) : content_(v) {}
    Value(std::string v) : content_(std::move(v)) {}
    Value(std::string_view v) : content_(std::string(v)) {}
    Value(const char* v) : content_(std::string(v)) {}
    Value(ItemId v) : content_(v) {}
    Value(Path v) : content_(std::move(v)) {}
    Value(RawText v) : content_(std::move(v)) {}

    /// The kind of the content. A choice is a Text.
    ValueKind kind() const;
    bool isNone() const { return std::holds_alternative<std::monostate>(content_); }
    bool isRaw() const { return std::holds_alternative<RawText>(content_); }
    /// The content as T; throws Failure naming both kinds when it is another. An integer reads as a real.
    template <class T>
    T as() const;
    template <class T>
    const T* get() const
    {
        return std::get_if<T>(&content_);
    }

    /// Bit-wise for reals, also those in vectors and paths: -0 differs from 0, a NaN equals itself. Undo depends on it.
    bool operator==(const Value& other) const;

    /// Locale-independent; the fewest digits that read back to the same bits. A vector is `x y`, an item its number.
    std::string text() const;
    /// Reads text as `kind`. Rejects NaN, infinities, trailing characters; the error says what was expected.
    static Result<Value> parse(ValueKind kind, std::string_view text);

    using Content =
        std::variant<std::monostate, bool, std::int64_t, double, Vec2, Color, std::string, ItemId, Path, RawText>;
    const Content& content() const { return content_; }

private:
    Content content_;
};

// clang-format off
template <> JET_API bool Value::as<bool>() const;
template <> JET_API int Value::as<int>() const;
template <> JET_API std::int64_t Value::as<std::int64_t>() const;
template <> JET_API double Value::as<double>() const;
template <> JET_API Vec2 Value::as<Vec2>() const;
template <> JET_API Color Value::as<Color>() const;
template <> JET_API std::string Value::as<std::string>() const;
template <> JET_API ItemId Value::as<ItemId>() const;
template <> JET_API Path Value::as<Path>() const;
// clang-format on

// Numbers as text, independent of locale (std::to_chars / from_chars): the fewest digits that read back to the same
// bits, without an exponent from 1e-5 to 1e15.
JET_API std::string numberText(double value);
JET_API void appendNumber(std::string& out, double value);
/// The number at the start of `text` (SVG/XML syntax: optional sign, digits, fraction, exponent), advancing it; no
/// inf/nan. False, and nothing changed, where there is none or it is too large for a double. One too small reads as 0.
JET_API bool readNumber(std::string_view& text, double& value);

}  // namespace jet
