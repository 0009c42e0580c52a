// Affine maps made from what they do.
#include <jet/geometry.hpp>

namespace jet {

Affine Affine::translation(const Vec2& by) { return Base(Eigen::Translation2d(by)); }

Affine Affine::scaling(const Vec2& factor, const Vec2& about)
{
    return Base(Eigen::Translation2d(about) * Eigen::Scaling(factor.x(), factor.y()) * Eigen::Translation2d(-about));
}

Affine Affine::rotation(double angle, const Vec2& about)
{
    return Base(Eigen::Translation2d(about) * Eigen::Rotation2Dd(angle) * Eigen::Translation2d(-about));
}

}  // namespace jet
