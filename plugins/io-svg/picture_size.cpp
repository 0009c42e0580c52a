#include "picture_size.hpp"

#include <cstdint>

namespace jet::svg {

namespace {

std::uint32_t number(std::string_view bytes, std::size_t at, int length)
{
    std::uint32_t value = 0;
    for (int i = 0; i < length; ++i) value = value << 8 | std::uint8_t(bytes[at + std::size_t(i)]);
    return value;
}

std::optional<Vec2> sizeOfPng(std::string_view bytes)
{
    if (bytes.size() < 24) return {};
    return Vec2(number(bytes, 16, 4), number(bytes, 20, 4));
}

std::optional<Vec2> sizeOfGif(std::string_view bytes)
{
    if (bytes.size() < 10) return {};
    const auto little = [&](std::size_t at) { return number(bytes, at, 1) + 256 * number(bytes, at + 1, 1); };
    return Vec2(little(6), little(8));
}

// Segments of a marker and a length, up to the frame's (ITU T.81, B.2.2).
std::optional<Vec2> sizeOfJpeg(std::string_view bytes)
{
    std::size_t at = 2;
    while (at + 9 < bytes.size() && std::uint8_t(bytes[at]) == 0xff) {
        const std::uint32_t marker = number(bytes, at + 1, 1);
        if (marker == 0xff) {  // filling
            ++at;
            continue;
        }
        if (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc)
            return Vec2(number(bytes, at + 7, 2), number(bytes, at + 5, 2));
        at += 2 + number(bytes, at + 2, 2);
    }
    return {};
}

int digitOfBase64(char c)
{
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    return c == '/' || c == '_' ? 63 : -1;
}

std::string fromBase64(std::string_view text)
{
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3);
    std::uint32_t held = 0;
    int bits = 0;
    for (const char c : text) {
        const int digit = digitOfBase64(c);
        if (digit < 0) continue;  // line ends, padding
        held = held << 6 | std::uint32_t(digit);
        if ((bits += 6) >= 8) bytes += char(held >> (bits -= 8) & 0xff);
    }
    return bytes;
}

int digitOfHex(char c)
{
    if (c >= '0' && c <= '9') return c - '0';
    const char lowered = char(c | 0x20);
    return lowered >= 'a' && lowered <= 'f' ? lowered - 'a' + 10 : -1;
}

std::string withoutPercents(std::string_view text)
{
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool coded =
            text[i] == '%' && i + 2 < text.size() && digitOfHex(text[i + 1]) >= 0 && digitOfHex(text[i + 2]) >= 0;
        out += coded ? char(16 * digitOfHex(text[i + 1]) + digitOfHex(text[i + 2])) : text[i];
        if (coded) i += 2;
    }
    return out;
}

}  // namespace

std::optional<Vec2> sizeOfPicture(std::string_view bytes)
{
    std::optional<Vec2> size;
    if (bytes.starts_with("\x89PNG\r\n\x1a\n")) size = sizeOfPng(bytes);
    if (bytes.starts_with("GIF8")) size = sizeOfGif(bytes);
    if (bytes.starts_with("\xff\xd8")) size = sizeOfJpeg(bytes);
    return size && size->minCoeff() > 0 ? size : std::nullopt;
}

std::optional<std::string> contentOfData(std::string_view address)
{
    const std::size_t comma = address.find(',');
    if (!address.starts_with("data:") || comma == address.npos) return {};
    const std::string content = withoutPercents(address.substr(comma + 1));
    return address.substr(0, comma).ends_with(";base64") ? fromBase64(content) : content;
}

}  // namespace jet::svg
