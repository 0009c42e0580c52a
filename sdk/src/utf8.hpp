// Which texts can be stored: UTF-8 without NUL. Files, undo and scripts all hand texts on as they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace jet {

/// Length of the UTF-8 sequence at the start of `text` (RFC 3629: no overlong forms, no surrogates); 0 where there is
/// none.
inline std::size_t utf8Length(std::string_view text)
{
    const auto byte = [&](std::size_t i) -> unsigned {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
    };
    const auto tail = [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i)
            if ((byte(i) & 0xc0U) != 0x80U) return false;
        return true;
    };
    const unsigned a = byte(0), b = byte(1);
    if (a < 0x80U) return text.empty() ? 0 : 1;
    if (a >= 0xc2U && a <= 0xdfU) return tail(1, 2) ? 2 : 0;
    if (a >= 0xe0U && a <= 0xefU) {
        if ((a == 0xe0U && b < 0xa0U) || (a == 0xedU && b > 0x9fU)) return 0;
        return tail(1, 3) ? 3 : 0;
    }
    if (a >= 0xf0U && a <= 0xf4U) {
        if ((a == 0xf0U && b < 0x90U) || (a == 0xf4U && b > 0x8fU)) return 0;
        return tail(1, 4) ? 4 : 0;
    }
    return 0;
}

/// Offset of the first byte that cannot be stored; npos if the text is fine.
inline std::size_t firstUnstorable(std::string_view text)
{
    std::size_t at = 0;
    while (at < text.size()) {
        // Eight ASCII bytes at a time: no high bit, no zero byte.
        while (at + 8 <= text.size()) {
            std::uint64_t word;
            std::memcpy(&word, text.data() + at, 8);
            const std::uint64_t zeros = (word - 0x0101010101010101ULL) & ~word & 0x8080808080808080ULL;
            if (((word & 0x8080808080808080ULL) | zeros) != 0) break;
            at += 8;
        }
        if (at == text.size()) break;
        const std::size_t length = text[at] == '\0' ? 0 : utf8Length(text.substr(at));
        if (length == 0) return at;
        at += length;
    }
    return std::string_view::npos;
}

}  // namespace jet
