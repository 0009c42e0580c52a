#include "soft/cloud_kernels.hpp"

#include <cmath>

namespace jet::physics::soft {

double drawn(const Cloud& cloud, const CloudMotion& motion, double tolerance, double h)
{
    double sum = 0;
    for (std::size_t n = 0; n < cloud.count; ++n) {
        const double *at = cloud.position + 2 * n, *moving = cloud.velocity + 2 * n, *rest = cloud.rest + 2 * n;
        const double armX = at[0] - motion.x, armY = at[1] - motion.y;
        const double x = motion.c * rest[0] - motion.s * rest[1] - armX;
        const double y = motion.s * rest[0] + motion.c * rest[1] - armY;
        const double now = std::sqrt(x * x + y * y);
        if (now <= tolerance) continue;
        // The goal moves with the motion.
        const double beforeX = x + h * (moving[0] - motion.vx + motion.omega * armY);
        const double beforeY = y + h * (moving[1] - motion.vy - motion.omega * armX);
        const double before = std::sqrt(beforeX * beforeX + beforeY * beforeY);
        if (before <= tolerance) continue;
        sum += cloud.mass[n] * (1 - tolerance / now) * (1 - tolerance / before) * (x * beforeX + y * beforeY);
    }
    return sum;
}

}  // namespace jet::physics::soft
