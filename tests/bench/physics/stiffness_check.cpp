#include "bench/physics/stiffness_check.hpp"

#include "bench/physics/energy.hpp"
#include "bench/physics/scene_soft.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace jet::bench {

namespace {

constexpr double kHertzOfScene = 30;

std::vector<Pose> posesOf(const Engine& engine, std::size_t bodies)
{
    std::vector<Pose> poses(bodies);
    for (std::size_t i = 0; i < bodies; ++i) poses[i] = engine.pose(i);
    return poses;
}

/// k goes with the square of the frequency, damping of one ratio with the frequency.
Scene sheetOf(double hertz)
{
    Scene scene = softSheet();
    const double times = hertz / kHertzOfScene;
    for (SceneSpring& spring : scene.springs) spring.stiffness *= times * times, spring.damping *= times;
    return scene;
}

bool isStable(double hertz)
{
    const Scene scene = sheetOf(hertz);
    const auto engine = makeJet(scene, {});
    // Of motion and height: what springs hold is left out, so that it can only be less than at the start, at rest.
    Scene weights = scene;
    weights.springs.clear();
    const double start = energyAtStart(weights).all();
    double most = -1e300, height = start;
    bool isNumber = true;
    std::vector<Pose> before = posesOf(*engine, scene.bodies.size());
    for (int i = 0; i < scene.warmUpSteps + scene.steps; ++i) {
        engine->step(scene.dt);
        std::vector<Pose> now = posesOf(*engine, scene.bodies.size());
        const Energy energy = energyOf(weights, before, now);
        // The velocity over a step is that of its middle; so is the mean of the heights.
        const double middle = energy.kinetic + 0.5 * (height + energy.potential);
        isNumber = isNumber && std::isfinite(middle);
        most = std::max(most, middle);
        height = energy.potential;
        before = std::move(now);
    }
    const bool fine = isNumber && most <= start;
    std::printf("sheet %4.0f Hz  motion and height: at most %+.2f J of the start%s\n", hertz, most - start,
                fine        ? ""
                : !isNumber ? "  NOT A NUMBER"
                            : "  IT GAINED ENERGY");
    return fine;
}

}  // namespace

bool everyStiffnessIsStable()
{
    bool fine = true;
    for (const double hertz : {30.0, 60.0, 120.0, 240.0, 480.0}) fine = isStable(hertz) && fine;
    return fine;
}

}  // namespace jet::bench
