// Paths to text. The grammar, of path_parse.cpp too, is SVG path data (SVG 2, chapter 9.3) and a few words added for
// what SVG cannot say:
//
//     path    = { command } { free } [ counts ]
//     command = one of MmLlHhVvCcSsQqTtAaZz with its numbers, the first one M or m
//     free    = ("i" | "o") contour x y     control point before the first / after the last segment of an open contour
//     counts  = "n" { count }               one for each segment
#include <jet/value.hpp>

#include "bits.hpp"

namespace jet {

namespace {

class PathWriter {
public:
    explicit PathWriter(const Path& path) : path_(path) { text_.reserve(48 * path.segmentCount()); }

    std::string write() &&
    {
        for (const Contour& contour : path_.contours()) writeContour(contour);
        writeFreeHandles();
        writeCounts();
        return std::move(text_);
    }

private:
    void word(char letter)
    {
        if (!text_.empty()) text_ += ' ';
        text_ += letter;
    }

    void point(const Vec2& p)
    {
        text_ += ' ';
        appendNumber(text_, p.x());
        text_ += ' ';
        appendNumber(text_, p.y());
    }

    void curve(const Segment& from, const Segment& to)
    {
        if (sameBits(from.out, from.point) && sameBits(to.in, to.point)) {
            word('L');
        } else {
            word('C');
            point(from.out);
            point(to.in);
        }
        point(to.point);
    }

    void writeContour(const Contour& contour)
    {
        const auto& segments = contour.segments;
        if (segments.empty()) return;
        const Segment &first = segments.front(), &last = segments.back();
        word('M');
        point(first.point);
        for (std::size_t i = 1; i < segments.size(); ++i) curve(segments[i - 1], segments[i]);
        if (!contour.closed) return;
        // Z draws a line by itself; but reading merges a last point equal to the first, so then the line is written out
        // too.
        const bool line = sameBits(last.out, last.point) && sameBits(first.in, first.point);
        if (!line || (segments.size() > 1 && last.point == first.point)) curve(last, first);
        word('Z');
    }

    void writeFreeHandles()
    {
        std::size_t index = 0;  // as it will be read: contours without segments are not written
        for (const Contour& contour : path_.contours()) {
            if (contour.segments.empty()) continue;
            const Segment &first = contour.segments.front(), &last = contour.segments.back();
            if (!contour.closed && !sameBits(first.in, first.point)) freeHandle('i', index, first.in);
            if (!contour.closed && !sameBits(last.out, last.point)) freeHandle('o', index, last.out);
            ++index;
        }
    }

    void freeHandle(char letter, std::size_t contour, const Vec2& p)
    {
        word(letter);
        text_ += ' ';
        text_ += std::to_string(contour);
        point(p);
    }

    void writeCounts()
    {
        const auto hasCount = [](const Segment& s) { return s.intermediate != 0; };
        const auto hasCounts = [&](const Contour& c) { return std::ranges::any_of(c.segments, hasCount); };
        if (std::ranges::none_of(path_.contours(), hasCounts)) return;
        word('n');
        for (const Contour& contour : path_.contours())
            for (const Segment& s : contour.segments) text_ += ' ' + std::to_string(s.intermediate);
    }

    const Path& path_;
    std::string text_;
};

}  // namespace

std::string Path::text() const { return PathWriter(*this).write(); }

}  // namespace jet
