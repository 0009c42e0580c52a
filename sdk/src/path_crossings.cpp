// Crossings of curves, and cutting at them.
#include <jet/path_operations.hpp>

#include <algorithm>

namespace jet {

namespace {

constexpr std::size_t kMostCrossings = 64;
constexpr int kMostSteps = 20'000;  // a budget for curves that run along each other
constexpr int kDeepest = 60;

struct Piece {
    Cubic curve;
    double from = 0, to = 1;

    Box box() const  // of the hull: cheaper than exact bounds, and enough to tell pieces apart
    {
        Box b;
        for (const Vec2& p : curve.p) b.extend(p);
        return b;
    }
    double middle() const { return 0.5 * (from + to); }
    std::array<Piece, 2> halves() const
    {
        const auto [left, right] = curve.split(0.5);
        return {Piece{left, from, middle()}, Piece{right, middle(), to}};
    }
};

class CrossingFinder {
public:
    CrossingFinder(const Cubic& a, const Cubic& b, double tolerance) : a_(a), b_(b), tolerance_(tolerance)
    {
        search({a, 0, 1}, {b, 0, 1}, 0);
        std::sort(found_.begin(), found_.end(), [](const Crossing& x, const Crossing& y) { return x.s < y.s; });
    }
    std::vector<Crossing> take() { return std::move(found_); }

private:
    void search(const Piece& a, const Piece& b, int depth)
    {
        if (++steps_ > kMostSteps || found_.size() >= kMostCrossings) return;
        const Box boxA = a.box(), boxB = b.box();
        if (!boxA.inflated(0.5 * tolerance_).intersects(boxB.inflated(0.5 * tolerance_))) return;
        const double sizeA = boxA.size().maxCoeff(), sizeB = boxB.size().maxCoeff();
        if (depth >= kDeepest || (sizeA < tolerance_ && sizeB < tolerance_)) return add(a.middle(), b.middle());
        if (sizeA >= sizeB) {
            for (const Piece& half : a.halves()) search(half, b, depth + 1);
        } else {
            for (const Piece& half : b.halves()) search(a, half, depth + 1);
        }
    }

    void add(double s, double t)
    {
        refine(s, t);
        const Vec2 point = 0.5 * (a_.at(s) + b_.at(t));
        const double near = 4 * tolerance_;
        for (const Crossing& known : found_) {
            if ((known.point - point).norm() < near && std::abs(known.s - s) < 0.01) return;
        }
        found_.push_back({s, t, point});
    }

    /// Newton's method on A(s) - B(t) = 0; a step that does not improve is not taken.
    void refine(double& s, double& t) const
    {
        for (int i = 0; i < 4; ++i) {
            const Vec2 gap = b_.at(t) - a_.at(s);
            const Vec2 da = a_.derivative(s), db = b_.derivative(t);
            const double det = cross(da, db);
            if (std::abs(det) < 1e-12 * da.norm() * db.norm() || det == 0) return;
            const double nextS = std::clamp(s + cross(gap, db) / det, 0.0, 1.0);
            const double nextT = std::clamp(t + cross(gap, da) / det, 0.0, 1.0);
            if ((b_.at(nextT) - a_.at(nextS)).norm() >= gap.norm()) return;
            s = nextS, t = nextT;
        }
    }

    const Cubic &a_, &b_;
    double tolerance_;
    int steps_ = 0;
    std::vector<Crossing> found_;
};

/// A place on a contour: curve index plus parameter.
using Place = double;

/// The crossings of one curve, as places; those at its ends are exactly there, so that what is found on both curves of
/// a segment is the same.
void addCuts(const Cubic& curve, std::size_t index, const Cubic& knife, double same, std::vector<Place>& cuts)
{
    for (const Crossing& c : crossings(curve, knife)) {
        const bool atStart = (c.point - curve.p[0]).norm() < same, atEnd = (c.point - curve.p[3]).norm() < same;
        cuts.push_back(static_cast<double>(index) + (atStart ? 0.0 : atEnd ? 1.0 : c.s));
    }
}

std::vector<Place> cutsOf(const Contour& contour, const Path& cutter)
{
    std::vector<Place> cuts;
    const auto count = static_cast<double>(contour.curveCount());
    for (std::size_t i = 0; i < contour.curveCount(); ++i) {
        const Cubic curve = contour.curve(i);
        const Box box = curve.bounds();
        for (const Contour& other : cutter.contours()) {
            for (std::size_t j = 0; j < other.curveCount(); ++j) {
                const Cubic knife = other.curve(j);
                if (box.intersects(knife.bounds())) addCuts(curve, i, knife, 1e-6 * box.size().maxCoeff(), cuts);
            }
        }
    }
    for (Place& at : cuts) {
        if (contour.closed && at == count) at = 0;
    }
    // Cutting the end of an open contour cuts nothing.
    if (!contour.closed) std::erase_if(cuts, [&](Place at) { return at == 0 || at == count; });
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end(), [](Place a, Place b) { return b - a < 1e-9; }), cuts.end());
    return cuts;
}

/// The part of a curve between two parameters.
Cubic between(const Cubic& curve, double from, double to)
{
    const Cubic right = from > 0 ? curve.split(from)[1] : curve;
    return to < 1 ? right.split((to - from) / (1 - from))[0] : right;
}

/// The open piece of a contour from one place to a later one, which may lie past its end when it is closed.
Contour pieceOf(const Contour& contour, Place from, Place to)
{
    const std::size_t count = contour.curveCount();
    Contour piece;
    for (Place at = from; at < to - 1e-9;) {
        const double index = std::floor(at + 1e-9);
        const double start = std::max(0.0, at - index), end = std::min(1.0, to - index);
        const auto i = static_cast<std::size_t>(index) % count;
        const Cubic curve = between(contour.curve(i), start, end);
        if (piece.segments.empty()) piece.segments.emplace_back(curve.p[0]);
        piece.segments.back().out = curve.p[1];
        piece.segments.back().intermediate = contour.segments[i].intermediate;
        piece.segments.emplace_back(curve.p[3], curve.p[2], curve.p[3]);
        at = index + 1;
    }
    return piece;
}

}  // namespace

std::vector<Crossing> crossings(const Cubic& a, const Cubic& b, double tolerance)
{
    return CrossingFinder(a, b, std::max(tolerance, 1e-12)).take();
}

std::vector<Path> cutPath(const Path& subject, const Path& cutter)
{
    std::vector<Path> pieces;
    for (const Contour& contour : subject.contours()) {
        std::vector<Place> cuts = cutsOf(contour, cutter);
        if (cuts.empty()) {
            pieces.push_back(Path({contour}));
            continue;
        }
        const auto count = static_cast<double>(contour.curveCount());
        if (contour.closed) {
            cuts.push_back(cuts.front() + count);
        } else {
            cuts.insert(cuts.begin(), 0.0);
            cuts.push_back(count);
        }
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
            pieces.push_back(Path({pieceOf(contour, cuts[i], cuts[i + 1])}));
        }
    }
    return pieces;
}

}  // namespace jet
