// Numbers, texts, values and items as bytes, and back. Reading trusts nothing: what does not fit throws Failure.
#pragma once

#include "scene_state.hpp"

#include <bit>
#include <cstring>

namespace jet {

class ByteWriter {
public:
    void byte(std::uint8_t b) { out_ += static_cast<char>(b); }
    /// Seven bits a byte, the lowest first (LEB128).
    void number(std::uint64_t n)
    {
        for (; n >= 0x80; n >>= 7) byte(static_cast<std::uint8_t>(n | 0x80));
        byte(static_cast<std::uint8_t>(n));
    }
    /// The eight bytes of the number's bits, the lowest first.
    void bits(std::uint64_t n)
    {
        for (int i = 0; i < 8; ++i) byte(static_cast<std::uint8_t>(n >> (8 * i)));
    }
    void real(double d) { bits(std::bit_cast<std::uint64_t>(d)); }
    void point(const Vec2& v) { real(v.x()), real(v.y()); }
    void text(std::string_view s)
    {
        number(s.size());
        out_ += s;
    }
    void path(const Path& path);
    void value(const Value& value);
    void properties(const Properties& properties);
    void effect(const EffectInstance& effect);
    void materials(const MaterialTable& table);
    /// Everything of an item but its children.
    void item(const Item& item);

    const std::string& bytes() const { return out_; }
    std::string take() { return std::move(out_); }

private:
    std::string out_;
};

class ByteReader {
public:
    explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

    bool atEnd() const { return rest_.empty(); }
    std::uint8_t byte();
    std::uint64_t number();
    std::uint64_t bits();
    /// A number that counts things of at least `least` bytes each, so that no damaged count asks for all memory.
    std::size_t count(std::size_t least = 1);
    double real();
    Vec2 point();
    std::string_view text();
    /// A text that a project file can hold, too.
    std::string storable();
    bool flag();
    Path path();
    Value value();
    Properties properties();
    EffectInstance effect();
    MaterialTable materials();
    std::unique_ptr<Item> item();

    [[noreturn]] static void fail(const char* what);

private:
    std::string_view rest_;
};

}  // namespace jet
