#include "bench/physics/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace jet::bench {

namespace {

struct Bound {
    const char *scene, *key;
    double least, most;
};

constexpr double kNone = -std::numeric_limits<double>::infinity();
constexpr double kAll = std::numeric_limits<double>::infinity();

// Metres, and metres a second; the steps are the scene's own.
constexpr Bound kBounds[] = {
    {"pyramid", "fallen", 0, 0},
    {"pyramid", "apex_sinks", kNone, 0.74},
    {"pyramid", "mean_overlap", 0, 0.0075},
    {"pyramid", "fastest", 0, 0.05},
    {"container", "escaped", 0, 0},
    {"container", "max_overlap", 0, 0.05},
    {"islands", "fallen", 0, 0},
    {"joint-grid", "mean_joint_error", 0, 0.007},
    {"joint-grid", "max_joint_error", 0, 0.09},
    {"tumbler", "escaped", 0, 0},
    {"soft-balls", "escaped", 0, 0},
    {"soft-balls", "merged", 0, 0},
    {"soft-balls", "touching_none", 0, 0},
    {"soft-balls", "inverted", 0, 0},
    {"soft-balls", "mean_area", 0.88, kAll},
    {"soft-balls", "max_overlap", 0, 0.03},
    // The sheet's height in double precision with 64 substeps a step.
    {"soft-sheet", "mean_bottom_height", -21.307 - 0.01, -21.307 + 0.01},
    {"bullets-static-wall", "passed", 0, 0},
    {"bullets-moving-plates", "passed", 0, 0},
};

bool isOf(const Bound& bound, const std::string& scene) { return scene == bound.scene; }

/// The tumbler's motor gives energy; all else can only lose it.
bool isDriven(const std::string& scene) { return scene == "tumbler"; }

/// What is no number is written as null.
double valueOf(const nlohmann::ordered_json& quality, const char* key)
{
    const auto found = quality.find(key);
    return found != quality.end() && found->is_number() ? found->get<double>() : std::nan("");
}

std::string sentence(const Bound& bound, double value)
{
    char text[160];
    if (bound.least == bound.most)
        std::snprintf(text, sizeof text, "%s is %.6g, it must be %.6g", bound.key, value, bound.most);
    else if (value < bound.least)
        std::snprintf(text, sizeof text, "%s is %.6g, it must be at least %.6g", bound.key, value, bound.least);
    else
        std::snprintf(text, sizeof text, "%s is %.6g, it must be at most %.6g", bound.key, value, bound.most);
    return text;
}

}  // namespace

std::vector<std::string> brokenBounds(const std::string& scene, const nlohmann::ordered_json& quality)
{
    std::vector<std::string> broken;
    for (const Bound& bound : kBounds) {
        if (!isOf(bound, scene)) continue;
        const double value = valueOf(quality, bound.key);
        if (!(value >= bound.least && value <= bound.most)) broken.push_back(sentence(bound, value));
    }
    if (boundsOf(scene) > 0 && !isDriven(scene)) {
        const double start = valueOf(quality, "energy_start"), end = valueOf(quality, "energy_end");
        if (!(end <= start)) broken.push_back(sentence({"", "energy_end", kNone, start}, end));
    }
    return broken;
}

std::size_t boundsOf(const std::string& scene)
{
    return static_cast<std::size_t>(
        std::count_if(std::begin(kBounds), std::end(kBounds), [&](const Bound& bound) { return isOf(bound, scene); }));
}

}  // namespace jet::bench
