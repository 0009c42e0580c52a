// The Bézier path every item has: contours of segments with two control points each, handled as curves, not polygons.
//
// A *segment* is the thesis's word (§3.4.1) for an anchor point with its two control points; the curve from one segment
// to the next is a cubic with control points {a.point, a.out, b.in, b.point}. All coordinates are absolute scene units.
#pragma once

#include <jet/geometry.hpp>
#include <jet/result.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace jet {

enum class FillRule { NonZero, EvenOdd };

/// One cubic Bézier piece: P(t) = sum B_i(t) p[i], t in [0, 1]. (Farin, Curves and Surfaces, ch. 4-5)
struct JET_API Cubic {
    std::array<Vec2, 4> p;

    /// The quadratic curve from a to b with control point `control`, raised to degree three.
    static Cubic quadratic(const Vec2& a, const Vec2& control, const Vec2& b);

    Vec2 at(double t) const;
    Vec2 derivative(double t) const;
    /// Exact bounds, from the roots of the derivative.
    Box bounds() const;
    /// de Casteljau: the parts left and right of t.
    std::array<Cubic, 2> split(double t) const;
    /// Arc length between parameters, adaptive Gauss-Legendre, to a relative 1e-10.
    double length(double t0 = 0, double t1 = 1) const;
    /// The t whose point is nearest to q: closest root of the quintic (P(t) - q)·P'(t) = 0, or an end.
    double nearest(const Vec2& q) const;
    /// Its points are those of its chord: both control points lie on the chord (to 1e-12 of the chord's length).
    bool isLine() const;
    /// The form a side between two corners has: the control points are the ends.
    bool isCornerLine() const { return p[0] == p[1] && p[2] == p[3]; }
};

/// The most intermediate points a segment may have. Files with more are refused: none shall ask for all memory.
inline constexpr int kMaxIntermediate = 1000;

/// An anchor point with its two control points and the number of intermediate points on the curve that starts here.
struct Segment {
    Vec2 point;            ///< on the curve
    Vec2 in;               ///< control point of the curve that ends here; equal to `point` for a corner
    Vec2 out;              ///< control point of the curve that starts here
    int intermediate = 0;  ///< points a polygon of this path takes strictly inside the curve that starts here

    Segment() = default;
    Segment(const Vec2& corner, int count = 0) : point(corner), in(corner), out(corner), intermediate(count) {}
    Segment(const Vec2& p, const Vec2& i, const Vec2& o, int count = 0) : point(p), in(i), out(o), intermediate(count)
    {
    }
    bool operator==(const Segment&) const = default;
};

/// One connected piece of a path.
struct JET_API Contour {
    std::vector<Segment> segments;
    bool closed = false;

    /// Number of cubic pieces: one a segment when closed, one less when open.
    std::size_t curveCount() const;
    Cubic curve(std::size_t index) const;
    bool operator==(const Contour&) const = default;
};

/// A place on a path.
struct PathPosition {
    std::size_t contour = 0;
    std::size_t curve = 0;
    double t = 0;
    Vec2 point;
    double distance = 0;  ///< from the query point, scene units
};

/// A polyline made from a contour.
struct Polyline {
    std::vector<Vec2> points;  ///< a closed polyline does not repeat its first point
    bool closed = false;
};

/// A list of contours. A value: a copy shares the points until one of the two changes, so copies cost next to nothing.
/// All queries are const and thread-safe. A reference from a function that is not const (contours(), segment()) is good
/// until the path is copied or destroyed.
class JET_API Path {
public:
    Path() = default;
    explicit Path(std::vector<Contour> contours);
    Path(const Path& other) noexcept;
    Path(Path&& other) noexcept : points_(std::exchange(other.points_, nullptr)) {}
    Path& operator=(const Path& other) noexcept;
    Path& operator=(Path&& other) noexcept;
    ~Path();

    static Path rectangle(const Box& box);
    /// Four segments with kappa = 4(√2-1)/3 (SPEC TO4), clockwise on screen from the right.
    static Path ellipse(const Box& box);
    static Path polygon(std::span<const Vec2> points, bool closed = true);
    static Path line(const Vec2& a, const Vec2& b);

    /// Builds contour by contour, as SVG path data does. lineTo etc. need a current point: throws Failure without one.
    /// After close() the current point is the start of the closed contour, where the next curve begins a new one.
    void moveTo(const Vec2& p);
    void lineTo(const Vec2& p);
    void quadTo(const Vec2& c, const Vec2& p);
    void cubicTo(const Vec2& c1, const Vec2& c2, const Vec2& p);
    /// SVG elliptical arc, rotation in radians (SVG 2, appendix B.2), as cubics of at most a quarter turn. A zero
    /// radius makes a line, radii too small to reach p are scaled up, an arc to the current point draws nothing.
    void arcTo(const Vec2& radii, double rotation, bool largeArc, bool sweep, const Vec2& p);
    /// Closes the current contour; a last point equal to the first is merged into it.
    void close();

    const std::vector<Contour>& contours() const;
    std::vector<Contour>& contours();
    bool isEmpty() const { return contours().empty(); }
    /// Segments of all contours, counted through: index i as used by transform(matrix, segments).
    std::size_t segmentCount() const;
    const Segment& segment(std::size_t index) const;
    Segment& segment(std::size_t index);
    bool isFinite() const;

    /// Exact bounds of the curves (not of the control points). Null for an empty path.
    Box bounds() const;
    double length() const;
    /// Signed area enclosed by the closed contours (Green's theorem on the cubics); positive when clockwise on screen.
    double area() const;
    /// Crossing test on the curves themselves. Open contours count as closed by a line, as SVG fills them.
    bool contains(const Vec2& p, FillRule rule = FillRule::NonZero) const;
    /// The nearest place on the path. Distance is infinite for an empty path.
    PathPosition nearest(const Vec2& p) const;
    /// Inserts a segment on the given curve at t without changing the shape. Intermediate points keep their side.
    void split(std::size_t contour, std::size_t curve, double t);
    /// The same curves run through backwards. A closed contour keeps its first segment.
    Path reversed() const;

    /// Polylines within `tolerance` (> 0, scene units) of the curves, without repeated points. A curve gives at most
    /// 4096 points, whatever its size.
    std::vector<Polyline> flatten(double tolerance) const;
    /// Polylines through the segments and their intermediate points, spaced evenly in t, on a straight side between
    /// corners evenly along it (the thesis's border, §3.5.2).
    std::vector<Polyline> polygonized() const;
    /// Sets the count of every segment, limited to 0 … kMaxIntermediate.
    void setIntermediate(int count);

    void transform(const Affine& m);
    /// Moves only the given segments (with their control points), each once; indices count through all contours.
    void transform(const Affine& m, std::span<const std::size_t> segments);
    Path transformed(const Affine& m) const;

    bool operator==(const Path& other) const;
    /// Do both have the very same points in memory, one being an unchanged copy of the other?
    bool sharesPoints(const Path& other) const { return points_ == other.points_; }
    /// Memory the points take, in bytes.
    std::size_t memory() const;

    /// The text form in project files: SVG path data in absolute `M L C Z` with shortest round-trip numbers, then what
    /// SVG has no word for, where it is there: ` i c x y` and ` o c x y`, the control points that no curve uses before
    /// the first and after the last segment of open contour c, and a final ` n…` list of intermediate counts:
    /// `M 0 0 L 10 0 L 10 5 Z n 2 2 2`. parse(text()) is this path bit for bit, if all coordinates are finite, the
    /// counts within 0 … kMaxIntermediate, and no contour is without segments (those are left out).
    std::string text() const;
    /// Reads text() and any SVG path data (all commands, relative and absolute). The error's column is that in `text`.
    static Result<Path> parse(std::string_view text);
    /// The same, but keeps what was read before the error, as SVG wants it drawn. `problem` receives the error, or an
    /// Error without a message.
    static Path parsePrefix(std::string_view text, Error* problem = nullptr);

private:
    Contour& current();  // the open contour that the next curve continues
    struct Points;       // contours with a count of the paths that share them
    Points* points_ = nullptr;
};

/// Kappa of the four-segment ellipse: 4(√2 - 1)/3.
inline constexpr double kEllipseKappa = 0.5522847498307936;

}  // namespace jet
