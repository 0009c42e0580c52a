#include "debug_marks.hpp"

#include <algorithm>
#include <string>

namespace jet::host {

namespace {

constexpr std::pair<std::string_view, bool PhysicsMarks::*> kWords[] = {
    {"contacts", &PhysicsMarks::contacts}, {"islands", &PhysicsMarks::islands}, {"stress", &PhysicsMarks::stress},
    {"boxes", &PhysicsMarks::boxes},       {"centres", &PhysicsMarks::centres}, {"joints", &PhysicsMarks::joints},
};

Error unknown(std::string_view word)
{
    std::string all;
    for (const auto& [name, mark] : kWords) all += std::string(name) + ", ";
    return Error("'" + std::string(word) + "' is nothing that can be shown; there are " + all + "and all");
}

}  // namespace

Result<PhysicsMarks> debugMarks(std::string_view words)
{
    PhysicsMarks marks;
    for (std::size_t begin = 0; begin <= words.size();) {
        const std::size_t end = std::min(words.find(',', begin), words.size());
        const std::string_view word = words.substr(begin, end - begin);
        bool known = false;
        for (const auto& [name, mark] : kWords)
            if (word == name || word == "all") marks.*mark = known = true;
        if (!known) return unknown(word);
        begin = end + 1;
    }
    return marks;
}

}  // namespace jet::host
