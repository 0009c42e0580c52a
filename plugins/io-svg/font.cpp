#include "font.hpp"

#include "document.hpp"
#include "length.hpp"

#include <algorithm>
#include <array>

namespace jet::svg {

namespace {

using Word = std::string_view;

constexpr Word kSpace = " \t\r\n\f";
constexpr std::array kSizes = {Word("xx-small"), Word("x-small"),  Word("small"),  Word("medium"), Word("large"),
                               Word("x-large"),  Word("xx-large"), Word("larger"), Word("smaller")};
constexpr std::array kWeights = {Word("bold"), Word("bolder"), Word("lighter")};
// Variants and widths that JET does not draw, and what resets all of them.
constexpr std::array kOthers = {Word("normal"),          Word("small-caps"), Word("ultra-condensed"),
                                Word("extra-condensed"), Word("condensed"),  Word("semi-condensed"),
                                Word("semi-expanded"),   Word("expanded"),   Word("extra-expanded"),
                                Word("ultra-expanded")};

template <class Words>
bool isOneOf(const Words& words, Word word)
{
    return std::ranges::find(words, word) != words.end();
}

bool isWeightNumber(Word word)
{
    const bool isNumber = !word.empty() && word.find_first_not_of("0123456789.") == Word::npos;
    return isNumber && parseNumber(word).value_or(0) >= 1;
}

bool isSize(Word word)
{
    const char first = word.empty() ? 'x' : word.front();
    return isOneOf(kSizes, word) || (first >= '0' && first <= '9') || first == '.' || first == '+';
}

}  // namespace

std::optional<FontShorthand> parseFont(std::string_view value)
{
    FontShorthand font;
    while (!value.empty()) {
        const Word word = value.substr(0, value.find_first_of(kSpace));
        const Word rest = trimmed(value.substr(word.size()));
        // A bare number before the size is a weight, as the size needs a unit, or is the last one before the family.
        const bool isWeight =
            isOneOf(kWeights, word) || (isWeightNumber(word) && isSize(rest.substr(0, rest.find_first_of(kSpace))));
        if (word == "italic" || word == "oblique") {
            font.style = word;
        } else if (isWeight) {
            font.weight = word;
        } else if (!isOneOf(kOthers, word)) {
            break;
        }
        value = rest;
    }
    const std::size_t sizeEnd = std::min(value.find_first_of(" \t\r\n\f/"), value.size());
    font.size = value.substr(0, sizeEnd);
    if (!isSize(font.size)) return std::nullopt;
    value = trimmed(value.substr(sizeEnd));
    if (value.starts_with('/')) {  // the height of lines, with or without space around it
        value = trimmed(value.substr(1));
        value = trimmed(value.substr(std::min(value.find_first_of(kSpace), value.size())));
    }
    if (value.empty()) return std::nullopt;
    font.family = value;
    return font;
}

}  // namespace jet::svg
