#include "text.hpp"

#include <cstdint>

namespace jet::duktape {

namespace {

constexpr char32_t kReplacement = 0xFFFD;

// One code point of possibly wrong UTF-8, with surrogates let through; advances.
char32_t decode(std::string_view& text)
{
    const auto at = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = at(0);
    const std::size_t length = lead < 0x80 ? 1 : lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC2 ? 2 : 0;
    if (length == 0 || length > text.size() || lead > 0xF4) {
        text.remove_prefix(1);
        return kReplacement;
    }
    char32_t c = length == 1 ? lead : lead & (0x7FU >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((at(i) & 0xC0U) != 0x80) {
            text.remove_prefix(i);
            return kReplacement;
        }
        c = (c << 6) | (at(i) & 0x3FU);
    }
    text.remove_prefix(length);
    return c > 0x10FFFF ? kReplacement : c;
}

void append(std::string& out, char32_t c)
{
    const auto put = [&](char32_t byte) { out.push_back(static_cast<char>(byte)); };
    if (c < 0x80) {
        put(c);
    } else if (c < 0x800) {
        put(0xC0 | (c >> 6)), put(0x80 | (c & 0x3F));
    } else if (c < 0x10000) {
        put(0xE0 | (c >> 12)), put(0x80 | ((c >> 6) & 0x3F)), put(0x80 | (c & 0x3F));
    } else {
        put(0xF0 | (c >> 18)), put(0x80 | ((c >> 12) & 0x3F)), put(0x80 | ((c >> 6) & 0x3F)), put(0x80 | (c & 0x3F));
    }
}

bool isAscii(std::string_view text)
{
    for (const char c : text)
        if (static_cast<unsigned char>(c) >= 0x80) return false;
    return true;
}

}  // namespace

std::string utf8FromCesu8(std::string_view text)
{
    if (isAscii(text)) return std::string(text);
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        char32_t c = decode(text);
        if (c >= 0xD800 && c < 0xDC00 && !text.empty()) {
            std::string_view rest = text;
            const char32_t low = decode(rest);
            if (low >= 0xDC00 && low < 0xE000) {
                c = 0x10000 + ((c - 0xD800) << 10) + (low - 0xDC00);
                text = rest;
            }
        }
        append(out, c >= 0xD800 && c < 0xE000 ? kReplacement : c);
    }
    return out;
}

std::string cesu8FromUtf8(std::string_view text)
{
    if (isAscii(text)) return std::string(text);
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const char32_t c = decode(text);
        if (c < 0x10000) {
            append(out, c);
        } else {
            append(out, 0xD800 + ((c - 0x10000) >> 10));
            append(out, 0xDC00 + ((c - 0x10000) & 0x3FF));
        }
    }
    return out;
}

void pushText(duk_context* ctx, std::string_view utf8)
{
    if (isAscii(utf8)) {
        duk_push_lstring(ctx, utf8.data(), utf8.size());
    } else {
        const std::string text = cesu8FromUtf8(utf8);
        duk_push_lstring(ctx, text.data(), text.size());
    }
}

std::string textAt(duk_context* ctx, duk_idx_t index)
{
    duk_dup(ctx, index);
    duk_size_t size = 0;
    if (duk_is_symbol(ctx, -1)) {
        duk_pop(ctx);
        return "Symbol()";
    }
    const char* data = duk_to_lstring(ctx, -1, &size);
    std::string text = utf8FromCesu8({data, size});
    duk_pop(ctx);
    return text;
}

std::string stringAt(duk_context* ctx, duk_idx_t index)
{
    if (!duk_is_string(ctx, index) || duk_is_symbol(ctx, index)) return {};
    duk_size_t size = 0;
    const char* data = duk_get_lstring(ctx, index, &size);
    return utf8FromCesu8({data, size});
}

std::string shortened(std::string text, std::size_t bytes)
{
    if (text.size() <= bytes) return text;
    std::size_t cut = bytes;
    while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0U) == 0x80) --cut;
    const std::size_t missing = text.size() - cut;
    text.resize(cut);
    return text + "… (" + std::to_string(missing) + " bytes more)";
}

}  // namespace jet::duktape
