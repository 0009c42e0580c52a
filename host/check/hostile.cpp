#include "hostile.hpp"

#include <algorithm>
#include <array>

namespace jet::host::check {

namespace {

std::string repeated(std::string_view text, std::size_t times)
{
    std::string all;
    all.reserve(text.size() * times);
    for (std::size_t i = 0; i < times; ++i) all += text;
    return all;
}

std::string randomBytes(Random& random, std::size_t size)
{
    std::string bytes(size, '\0');
    for (char& c : bytes) c = static_cast<char>(random.bits());
    return bytes;
}

/// Puts something else in the place of a random run of digits.
std::string withNumber(const std::string& sample, std::string_view number, Random& random)
{
    const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
    const auto start = sample.begin() + static_cast<std::ptrdiff_t>(random.below(sample.size() + 1));
    const auto first = std::find_if(start, sample.end(), isDigit);
    const auto last = std::find_if_not(first, sample.end(), isDigit);
    return std::string(sample.begin(), first) + std::string(number) + std::string(last, sample.end());
}

}  // namespace

std::vector<HostileFile> genericHostileFiles(Random& random)
{
    std::vector<HostileFile> files{
        {"empty", ""},
        {"one zero byte", std::string(1, '\0')},
        {"a byte order mark alone", "\xEF\xBB\xBF"},
        {"UTF-16", std::string("\xFF\xFE<\0a\0>\0", 8)},
        {"100,000 spaces", std::string(100'000, ' ')},
        {"a line of a million characters", std::string(1'000'000, 'a')},
        {"a million zeros", std::string(1'000'000, '\0')},
        {"100,000 nested '<a>'", repeated("<a>", 100'000)},
        {"100,000 nested '['", repeated("[", 100'000)},
        {"100,000 nested '{'", repeated("{\"a\":", 100'000)},
        {"100,000 nested '('", repeated("(", 100'000)},
        {"100,000 numbers", repeated("1e999 ", 100'000)},
        {"entities that grow",
         "<!DOCTYPE a [<!ENTITY b \"bbbbbbbbbb\"><!ENTITY c \"&b;&b;&b;&b;&b;&b;&b;&b;\"><!ENTITY d "
         "\"&c;&c;&c;&c;&c;&c;&c;&c;\"><!ENTITY e \"&d;&d;&d;&d;&d;&d;&d;&d;\"><!ENTITY f \"&e;&e;&e;&e;&e;&e;&e;&e;\">"
         "<!ENTITY g \"&f;&f;&f;&f;&f;&f;&f;&f;\"><!ENTITY h \"&g;&g;&g;&g;&g;&g;&g;&g;\">]><a>&h;&h;&h;</a>"},
    };
    for (const std::size_t size : {1U, 7U, 64U, 1000U, 65536U})
        for (int i = 0; i < 4; ++i)
            files.push_back({std::to_string(size) + " random bytes", randomBytes(random, size)});
    return files;
}

std::vector<HostileFile> damaged(const std::string& sample, Random& random)
{
    std::vector<HostileFile> files;
    if (sample.empty()) return files;
    const std::string of = " of " + std::to_string(sample.size()) + " bytes";
    for (std::size_t i = 0; i < 64; ++i) {
        const std::size_t size = i < 16 ? std::min(i, sample.size()) : random.below(sample.size());
        files.push_back({"truncated to " + std::to_string(size) + of, sample.substr(0, size)});
    }
    for (int i = 0; i < 200; ++i) {
        std::string flipped = sample;
        const std::size_t at = random.below(sample.size());
        flipped[at] = static_cast<char>(flipped[at] ^ (1U << random.below(8)));
        files.push_back({"with a bit flipped at byte " + std::to_string(at) + of, std::move(flipped)});
    }
    for (int i = 0; i < 40; ++i) {
        const std::size_t at = random.below(sample.size()),
                          size = 1 + random.below(std::min<std::size_t>(sample.size() - at, 200));
        files.push_back({"without bytes " + std::to_string(at) + " to " + std::to_string(at + size),
                         std::string(sample).erase(at, size)});
        files.push_back({"with bytes " + std::to_string(at) + " to " + std::to_string(at + size) + " repeated",
                         std::string(sample).insert(at, repeated(sample.substr(at, size), 1 + random.below(20)))});
        files.push_back({"with random bytes at " + std::to_string(at),
                         std::string(sample).replace(at, size, randomBytes(random, size))});
    }
    static constexpr std::array numbers = {
        "1e308", "-1e308", "1e-320",     "99999999999999999999999999", "-1",    "0",
        "NaN",   "inf",    "2147483648", "18446744073709551616",       "1e999", "0.0000000000000001",
        "",      "--",     "1000000000"};
    for (int i = 0; i < 75; ++i) {
        const char* number = numbers[random.below(numbers.size())];
        files.push_back({std::string("with a number made '") + number + "'", withNumber(sample, number, random)});
    }
    return files;
}

}  // namespace jet::host::check
