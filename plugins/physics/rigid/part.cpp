#include "part.hpp"

#include "trigonometry.hpp"

namespace jet::physics {

namespace {

Vec2f single(const Vec2& v) { return {static_cast<float>(v.x()), static_cast<float>(v.y())}; }

double signedArea(const Vec2* at, int count)
{
    double twice = 0;
    for (int i = 0; i < count; ++i) twice += cross(at[i] - at[0], at[(i + 1) % count] - at[0]);
    return 0.5 * twice;
}

}  // namespace

Part makePart(const Vec2* corners, int count, double radius)
{
    Part part;
    part.count = static_cast<std::uint8_t>(count);
    part.radius = static_cast<float>(radius);
    const double area = signedArea(corners, count);
    part.reversed = area < 0;
    double around = 0, reach = 0, thickness = 1e300;
    for (int i = 0; i < count; ++i) {
        const Vec2& at = corners[area < 0 ? count - 1 - i : i];
        const Vec2& next = corners[area < 0 ? (2 * count - 2 - i) % count : (i + 1) % count];
        part.corners[i] = single(at);
        reach = std::max(reach, at.norm() + radius);
        if (count == 1) break;
        const double length = (next - at).norm();
        const Vec2 normal = -perpendicular(next - at) / length;
        part.normals[i] = single(normal);
        around += count == 2 ? length / 2 : length;
        double deepest = 0;
        for (int k = 0; k < count; ++k) deepest = std::max(deepest, (at - corners[k]).dot(normal));
        thickness = std::min(thickness, deepest);
    }
    for (int i = count; i <= kMostCorners; ++i) part.corners[i] = part.corners[0];
    for (int i = count; i < kMostCorners; ++i) part.normals[i] = part.normals[0];
    part.reach = static_cast<float>(reach);
    part.thickness = static_cast<float>((count > 1 ? thickness : 0) + 2 * radius);
    part.length = static_cast<float>(
        std::sqrt(std::abs(area) + (count == 2 ? 2 * around : around) * radius + kPi * radius * radius));
    return part;
}

Vec2f Part::centre() const
{
    Vec2f sum;
    for (int i = 0; i < count; ++i) sum = sum + corners[i];
    return (1 / static_cast<float>(count)) * sum;
}

}  // namespace jet::physics
