// Making and editing paths. Questions about their geometry are in path_query.cpp, polylines in path_flatten.cpp, text
// in path_text.cpp.
#include <jet/path.hpp>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <numbers>

namespace jet {

// Copies share the points: an undo step, the item and a snapshot for play hold the same ones. What changes a path goes
// through the contours() that is not const and gets points of its own, unless it has them already.
struct Path::Points {
    std::vector<Contour> contours;
    std::atomic<std::uint32_t> owners{1};
};

Path::Path(std::vector<Contour> contours) : points_(new Points{std::move(contours)}) {}

Path::Path(const Path& other) noexcept : points_(other.points_)
{
    if (points_) points_->owners.fetch_add(1, std::memory_order_relaxed);
}

Path::~Path()
{
    if (points_ && points_->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) delete points_;
}

Path& Path::operator=(const Path& other) noexcept
{
    if (points_ != other.points_) *this = Path(other);
    return *this;
}

Path& Path::operator=(Path&& other) noexcept
{
    std::swap(points_, other.points_);
    return *this;
}

const std::vector<Contour>& Path::contours() const
{
    static const std::vector<Contour> none;
    return points_ ? points_->contours : none;
}

std::vector<Contour>& Path::contours()
{
    if (!points_) {
        points_ = new Points;
    } else if (points_->owners.load(std::memory_order_acquire) > 1) {
        *this = Path(points_->contours);
    }
    return points_->contours;
}

bool Path::operator==(const Path& other) const { return contours() == other.contours(); }

std::size_t Path::memory() const
{
    if (!points_) return 0;
    std::size_t bytes = sizeof(Points) + points_->contours.capacity() * sizeof(Contour);
    for (const Contour& contour : points_->contours) bytes += contour.segments.capacity() * sizeof(Segment);
    return bytes;
}

std::size_t Contour::curveCount() const
{
    if (segments.empty()) return 0;
    return closed ? segments.size() : segments.size() - 1;
}

Cubic Contour::curve(std::size_t index) const
{
    assert(index < curveCount());
    const Segment& from = segments[index];
    const Segment& to = segments[index + 1 == segments.size() ? 0 : index + 1];
    return {{from.point, from.out, to.in, to.point}};
}

Path Path::rectangle(const Box& box)
{
    if (box.isNull()) return {};
    const std::array<Vec2, 4> corners{box.min, Vec2(box.max.x(), box.min.y()), box.max, Vec2(box.min.x(), box.max.y())};
    return polygon(corners);
}

Path Path::ellipse(const Box& box)
{
    if (box.isNull()) return {};
    const Vec2 center = box.center(), radii = 0.5 * box.size();
    Contour contour;
    contour.closed = true;
    for (const Vec2& axis : {Vec2(1, 0), Vec2(0, 1), Vec2(-1, 0), Vec2(0, -1)}) {
        const Vec2 point = center + axis.cwiseProduct(radii);
        const Vec2 handle = kEllipseKappa * perpendicular(axis).cwiseProduct(radii);
        contour.segments.emplace_back(point, point - handle, point + handle);
    }
    return Path({std::move(contour)});
}

Path Path::polygon(std::span<const Vec2> points, bool closed)
{
    if (points.empty()) return {};
    Contour contour;
    contour.closed = closed;
    contour.segments.assign(points.begin(), points.end());
    return Path({std::move(contour)});
}

Path Path::line(const Vec2& a, const Vec2& b) { return polygon(std::array<Vec2, 2>{a, b}, false); }

void Path::moveTo(const Vec2& p) { contours().emplace_back().segments.emplace_back(p); }

void Path::lineTo(const Vec2& p)
{
    auto& segments = current().segments;
    segments.back().out = segments.back().point;
    segments.emplace_back(p);
}

void Path::quadTo(const Vec2& c, const Vec2& p)
{
    auto& segments = current().segments;
    const Cubic curve = Cubic::quadratic(segments.back().point, c, p);
    segments.back().out = curve.p[1];
    segments.emplace_back(p, curve.p[2], p);
}

void Path::cubicTo(const Vec2& c1, const Vec2& c2, const Vec2& p)
{
    auto& segments = current().segments;
    segments.back().out = c1;
    segments.emplace_back(p, c2, p);
}

void Path::arcTo(const Vec2& radii, double rotation, bool largeArc, bool sweep, const Vec2& p)
{
    const Vec2 from = current().segments.back().point;
    if (from == p) return;

    // With the radii and the rotation divided out the ellipse is the unit circle, and its chord runs from u to -u
    // around the chord's middle (SVG 2, B.2.4).
    const Vec2 r = radii.cwiseAbs();
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(rotation).toRotationMatrix();
    Vec2 u = (turn.transpose() * (0.5 * (from - p))).cwiseQuotient(r);
    const double reach = std::hypot(u.x(), u.y());
    if (!(r.x() > 0 && r.y() > 0) || !(reach > 0) || !std::isfinite(reach)) return lineTo(p);
    const double growth = std::max(1.0, reach);  // of radii too small to reach p (B.2.5)
    u /= growth;
    const double offset = reach < 1 ? std::sqrt(1 / u.squaredNorm() - 1) * (largeArc == sweep ? -1 : 1) : 0;
    const Vec2 center(offset * u.y(), -offset * u.x());

    const Vec2 start = u - center, end = -u - center;
    const double startAngle = std::atan2(start.y(), start.x());
    double angle = std::atan2(cross(start, end), start.dot(end));
    if (sweep && angle < 0) angle += 2 * std::numbers::pi;
    if (!sweep && angle > 0) angle -= 2 * std::numbers::pi;
    const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(angle) / (0.5 * std::numbers::pi) - 1e-9)));
    const double step = angle / pieces;
    const double kappa = 4.0 / 3.0 * std::tan(0.25 * step);

    const auto unit = [](double a) { return Vec2(std::cos(a), std::sin(a)); };
    const auto place = [&](const Vec2& v) -> Vec2 {
        return 0.5 * (from + p) + turn * (growth * r.cwiseProduct(center + v));
    };
    if (!jet::isFinite(place(Vec2(2, 2))) || !jet::isFinite(place(Vec2(-2, -2)))) return lineTo(p);  // overflow
    for (int i = 0; i < pieces; ++i) {
        const Vec2 a = unit(startAngle + i * step), b = unit(startAngle + (i + 1) * step);
        cubicTo(place(a + kappa * perpendicular(a)), place(b - kappa * perpendicular(b)),
                i + 1 < pieces ? place(b) : p);
    }
}

void Path::close()
{
    if (isEmpty() || contours().back().segments.empty())
        throw Failure(Error("A path must begin with moveTo before it can be closed."));
    Contour& contour = contours().back();
    if (contour.closed) return;
    contour.closed = true;
    auto& segments = contour.segments;
    if (segments.size() > 1 && segments.back().point == segments.front().point) {
        segments.front().in = segments.back().in;
        segments.pop_back();
    }
}

Contour& Path::current()
{
    if (isEmpty() || contours().back().segments.empty())
        throw Failure(Error("A path must begin with moveTo before a line or curve can be added."));
    if (contours().back().closed) moveTo(Vec2(contours().back().segments.front().point));
    return contours().back();
}

std::size_t Path::segmentCount() const
{
    std::size_t count = 0;
    for (const Contour& contour : contours()) count += contour.segments.size();
    return count;
}

const Segment& Path::segment(std::size_t index) const
{
    auto contour = contours().begin();
    while (assert(contour != contours().end()), index >= contour->segments.size())
        index -= (contour++)->segments.size();
    return contour->segments[index];
}

Segment& Path::segment(std::size_t index)
{
    contours();  // makes the points this path's own
    return const_cast<Segment&>(std::as_const(*this).segment(index));
}

bool Path::isFinite() const
{
    for (const Contour& contour : contours())
        for (const Segment& s : contour.segments)
            if (!jet::isFinite(s.point) || !jet::isFinite(s.in) || !jet::isFinite(s.out)) return false;
    return true;
}

void Path::split(std::size_t contourIndex, std::size_t curveIndex, double t)
{
    assert(contourIndex < contours().size());
    Contour& contour = contours()[contourIndex];
    const Cubic curve = contour.curve(curveIndex);
    t = t > 0 ? std::min(t, 1.0) : 0.0;

    Segment& from = contour.segments[curveIndex];
    Segment& to = contour.segments[(curveIndex + 1) % contour.segments.size()];
    Segment middle(curve.at(t));
    if (!curve.isCornerLine()) {
        const auto [left, right] = curve.split(t);
        from.out = left.p[1];
        middle = Segment(left.p[3], left.p[2], right.p[1]);
        to.in = right.p[2];
    }
    // The n intermediate points stand at i / (n + 1); one at t itself has become the segment.
    const int count = std::max(from.intermediate, 0);
    const double share =
        curve.isCornerLine() ? t * t * (3 - 2 * t) : t;  // of a straight side, by length (see polygonized())
    const double place = share * (count + 1);
    from.intermediate = std::clamp(static_cast<int>(std::ceil(place)) - 1, 0, count);
    middle.intermediate = std::clamp(count - static_cast<int>(std::floor(place)), 0, count - from.intermediate);
    contour.segments.insert(contour.segments.begin() + static_cast<std::ptrdiff_t>(curveIndex) + 1, middle);
}

Path Path::reversed() const
{
    Path result = *this;
    for (Contour& contour : result.contours()) {
        auto& segments = contour.segments;
        if (segments.empty()) continue;
        std::vector<int> counts;  // of the curves, which turn round with them
        for (std::size_t i = 0; i < contour.curveCount(); ++i) counts.push_back(segments[i].intermediate);
        std::reverse(segments.begin() + (contour.closed ? 1 : 0), segments.end());
        for (Segment& s : segments) std::swap(s.in, s.out);
        if (!contour.closed) segments.back().intermediate = std::exchange(segments.front().intermediate, 0);
        for (std::size_t i = 0; i < counts.size(); ++i) segments[i].intermediate = counts[counts.size() - 1 - i];
    }
    return result;
}

void Path::setIntermediate(int count)
{
    for (Contour& contour : contours())
        for (Segment& s : contour.segments) s.intermediate = std::clamp(count, 0, kMaxIntermediate);
}

namespace {

void transformSegment(Segment& s, const Affine& m)
{
    s.point = m * s.point;
    s.in = m * s.in;
    s.out = m * s.out;
}

}  // namespace

void Path::transform(const Affine& m)
{
    for (Contour& contour : contours())
        for (Segment& s : contour.segments) transformSegment(s, m);
}

void Path::transform(const Affine& m, std::span<const std::size_t> segments)
{
    std::vector<std::size_t> sorted(segments.begin(), segments.end());
    std::ranges::sort(sorted);
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());

    auto next = sorted.begin();
    std::size_t first = 0;  // index of the contour's first segment
    for (Contour& contour : contours()) {
        for (; next != sorted.end() && *next < first + contour.segments.size(); ++next)
            transformSegment(contour.segments[*next - first], m);
        first += contour.segments.size();
    }
    assert(next == sorted.end() && "a segment index is beyond the path");
}

Path Path::transformed(const Affine& m) const
{
    Path result = *this;
    result.transform(m);
    return result;
}

}  // namespace jet
