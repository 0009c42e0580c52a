// Joining open contours, and the orientation of closed ones.
#include <jet/path_operations.hpp>

#include <algorithm>
#include <optional>

namespace jet {

namespace {

struct Ends {
    std::size_t first = 0, second = 0;                // contours; equal: its own two ends
    bool firstAtStart = false, secondAtStart = true;  // which end of each
    double distance = 0;
};

const Vec2& endOf(const Contour& contour, bool start)
{
    return start ? contour.segments.front().point : contour.segments.back().point;
}

Contour reversed(const Contour& contour) { return Path({contour}).reversed().contours().front(); }

/// The nearest ends of two different contours.
std::optional<Ends> nearestEnds(const std::vector<Contour>& open)
{
    std::optional<Ends> best;
    for (std::size_t i = 0; i < open.size(); ++i) {
        for (std::size_t j = i + 1; j < open.size(); ++j) {
            for (const bool a : {false, true}) {
                for (const bool b : {true, false}) {
                    const double distance = (endOf(open[i], a) - endOf(open[j], b)).norm();
                    if (!best || distance < best->distance) best = Ends{i, j, a, b, distance};
                }
            }
        }
    }
    return best;
}

/// The end of `a` continued by the start of `b`: one segment where they meet, else a straight side between.
Contour chained(Contour a, const Contour& b, double tolerance)
{
    auto next = b.segments.begin();
    Segment& last = a.segments.back();
    if ((last.point - next->point).norm() <= tolerance) {
        last.out = next->out;
        last.intermediate = next->intermediate;
        ++next;
    } else {
        last.out = last.point;
        a.segments.emplace_back(next->point, next->point, next->out, next->intermediate);
        ++next;
    }
    a.segments.insert(a.segments.end(), next, b.segments.end());
    return a;
}

void closeContour(Contour& contour, double tolerance)
{
    Segment& first = contour.segments.front();
    const Segment& last = contour.segments.back();
    if (contour.segments.size() > 2 && (first.point - last.point).norm() <= tolerance) {
        first.in = last.in;
        contour.segments.pop_back();
    } else {
        first.in = first.point;
        contour.segments.back().out = contour.segments.back().point;
    }
    contour.closed = true;
}

}  // namespace

Path joinPaths(std::span<const Path> paths, double tolerance)
{
    std::vector<Contour> closed, open;
    for (const Path& path : paths) {
        for (const Contour& contour : path.contours()) {
            if (contour.segments.empty()) continue;
            (contour.closed ? closed : open).push_back(contour);
        }
    }
    const bool single = open.size() == 1;
    while (const std::optional<Ends> ends = nearestEnds(open)) {
        const Contour first = ends->firstAtStart ? reversed(open[ends->first]) : open[ends->first];
        const Contour second = ends->secondAtStart ? open[ends->second] : reversed(open[ends->second]);
        open[ends->first] = chained(first, second, tolerance);
        open.erase(open.begin() + static_cast<std::ptrdiff_t>(ends->second));
    }
    if (!open.empty()) {
        Contour& left = open.front();
        const bool meets = left.segments.size() > 2 && (endOf(left, true) - endOf(left, false)).norm() <= tolerance;
        if (left.segments.size() > 1 && (single || meets)) closeContour(left, tolerance);
        closed.push_back(std::move(left));
    }
    return Path(std::move(closed));
}

Path orientContours(const Path& path)
{
    std::vector<Contour> turned;
    const std::vector<Contour>& contours = path.contours();
    for (std::size_t i = 0; i < contours.size(); ++i) {
        if (!contours[i].closed || contours[i].segments.empty()) {
            turned.push_back(contours[i]);
            continue;
        }
        const Path own({contours[i]});
        int depth = 0;
        // Contours of a cleaned path touch at most in points: the middle of a curve tells where the whole of it lies.
        const Vec2 probe = contours[i].curve(0).at(0.4375);
        for (std::size_t j = 0; j < contours.size(); ++j) {
            if (j != i && contours[j].closed && Path({contours[j]}).contains(probe)) ++depth;
        }
        const bool clockwise = own.area() > 0;
        turned.push_back(clockwise == (depth % 2 == 0) ? contours[i] : reversed(contours[i]));
    }
    return Path(std::move(turned));
}

}  // namespace jet
