// A 64-bit hash over canonical bytes: the same content gives the same number in every process and on every machine.
#pragma once

#include <jet/value.hpp>

#include <cstring>
#include <string_view>

namespace jet {

class Hasher {
public:
    /// splitmix64's finalizer over a running sum (Steele, Lea, Flood 2014).
    void add(std::uint64_t word)
    {
        state_ += word + 0x9e3779b97f4a7c15ULL;
        state_ = (state_ ^ (state_ >> 30)) * 0xbf58476d1ce4e5b9ULL;
        state_ = (state_ ^ (state_ >> 27)) * 0x94d049bb133111ebULL;
        state_ ^= state_ >> 31;
    }
    void add(double number)
    {
        std::uint64_t bits;
        std::memcpy(&bits, &number, sizeof bits);
        add(bits);
    }
    void add(const Vec2& v) { add(v.x()), add(v.y()); }
    void add(std::string_view text)
    {
        add(static_cast<std::uint64_t>(text.size()));
        while (!text.empty()) {
            std::uint64_t word = 0;
            const std::size_t n = std::min(text.size(), sizeof word);
            std::memcpy(&word, text.data(), n);
            add(word);
            text.remove_prefix(n);
        }
    }
    void add(const Path& path)
    {
        add(static_cast<std::uint64_t>(path.contours().size()));
        for (const Contour& contour : path.contours()) {
            add(static_cast<std::uint64_t>(contour.segments.size() * 2 + (contour.closed ? 1 : 0)));
            for (const Segment& s : contour.segments)
                add(s.point), add(s.in), add(s.out), add(static_cast<std::uint64_t>(s.intermediate));
        }
    }
    void add(const Value& value)
    {
        add(static_cast<std::uint64_t>(value.content().index()));
        if (const Path* path = value.get<Path>()) {
            add(*path);
        } else {
            add(std::string_view(value.text()));
        }
    }
    std::uint64_t value() const { return state_; }

private:
    std::uint64_t state_ = 0;
};

}  // namespace jet
