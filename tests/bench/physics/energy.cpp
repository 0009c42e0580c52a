#include "bench/physics/energy.hpp"

#include <cmath>

namespace jet::bench {

namespace {

struct Motion {
    Point position, velocity;  // of the centre of mass
    double omega = 0;
};

Point centreOf(const Pose& pose, const Point& local)
{
    const double c = std::cos(pose.angle), s = std::sin(pose.angle);
    return {pose.position.x + c * local.x - s * local.y, pose.position.y + s * local.x + c * local.y};
}

void add(Energy& sum, const Scene& scene, const SceneBody& body, const AreaMoments& moments, const Motion& motion)
{
    const double density = body.mass > 0 ? body.mass / moments.area : 1, mass = density * moments.area;
    const Point &c = moments.centroid, &v = motion.velocity;
    const double inertia =
        body.fixedRotation ? 0 : density * (moments.secondMoment - moments.area * (c.x * c.x + c.y * c.y));
    sum.kinetic += 0.5 * mass * (v.x * v.x + v.y * v.y) + 0.5 * inertia * motion.omega * motion.omega;
    sum.potential -= mass * (scene.gravity.x * motion.position.x + scene.gravity.y * motion.position.y);
}

double stretched(const SceneSpring& spring, const Point& a, const Point& b)
{
    const double stretch = std::hypot(a.x - b.x, a.y - b.y) - spring.restLength;
    return 0.5 * spring.stiffness * stretch * stretch;
}

bool moves(const SceneBody& body) { return body.type == SceneBody::Type::Dynamic; }

}  // namespace

Energy energyAtStart(const Scene& scene)
{
    Energy sum;
    for (const SceneBody& body : scene.bodies) {
        if (!moves(body)) continue;
        const AreaMoments moments = momentsOf(body);
        // No scene has a body that turns at first and whose centre is not its origin.
        add(sum, scene, body, moments,
            {centreOf({body.position, body.angle}, moments.centroid), body.velocity, body.omega});
    }
    for (const SceneSpring& spring : scene.springs)
        sum.potential += stretched(spring, scene.bodies[spring.a].position, scene.bodies[spring.b].position);
    return sum;
}

Energy energyOf(const Scene& scene, const std::vector<Pose>& before, const std::vector<Pose>& now)
{
    Energy sum;
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (!moves(scene.bodies[i])) continue;
        const AreaMoments moments = momentsOf(scene.bodies[i]);
        const Point is = centreOf(now[i], moments.centroid), was = centreOf(before[i], moments.centroid);
        // Engines may tell angles as they like, within a turn.
        const double turned = std::remainder(now[i].angle - before[i].angle, 2 * 3.14159265358979323846);
        add(sum, scene, scene.bodies[i], moments,
            {is, {(is.x - was.x) / scene.dt, (is.y - was.y) / scene.dt}, turned / scene.dt});
    }
    for (const SceneSpring& spring : scene.springs)
        sum.potential += stretched(spring, now[spring.a].position, now[spring.b].position);
    return sum;
}

}  // namespace jet::bench
