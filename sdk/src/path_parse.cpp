// Paths from text: the grammar at the top of path_text.cpp, by recursive descent. Errors name what was expected.
#include <jet/value.hpp>

#include <charconv>
#include <numbers>
#include <utility>

namespace jet {

namespace {

class PathReader {
public:
    explicit PathReader(std::string_view text) : text_(text), rest_(text) {}

    Path read(Error& problem)
    {
        problem = {};
        for (skipSpace(); !rest_.empty(); skipSpace())
            if (!command()) {
                problem = std::move(problem_);
                break;
            }
        return std::move(path_);
    }

private:
    bool fail(std::string_view expected, std::string_view where)
    {
        problem_.message = "The path data should have " + std::string(expected) + " here, but ";
        if (where.empty()) {
            problem_.message += "it ends.";
        } else {
            const auto byte = static_cast<unsigned char>(where.front());
            const bool printable = byte >= 0x20 && byte < 0x7f;
            problem_.message +=
                printable ? std::string("has '") + where.front() + "'." : "has an unprintable character.";
        }
        problem_.where.column = static_cast<int>(where.data() - text_.data()) + 1;
        return false;
    }
    bool fail(std::string_view expected) { return fail(expected, rest_); }

    // --- tokens

    void skipSpace()
    {
        const std::size_t count = rest_.find_first_not_of(" \t\n\r\f");
        rest_.remove_prefix(std::min(count, rest_.size()));
    }

    bool skipComma()
    {
        skipSpace();
        if (rest_.empty() || rest_.front() != ',') return false;
        rest_.remove_prefix(1);
        skipSpace();
        return true;
    }

    bool number(double& value)
    {
        if (readNumber(rest_, value)) return true;
        const bool begins = !rest_.empty() && std::string_view("+-.0123456789").find(rest_.front()) != rest_.npos;
        return fail(begins ? "a number that is complete and below 1.8e308" : "a number");
    }

    bool numbers(std::initializer_list<double*> values)
    {
        bool first = true;
        for (double* value : values) {
            if (!std::exchange(first, false)) skipComma();
            if (!number(*value)) return false;
        }
        return true;
    }

    /// Points separated by commas or space, made absolute.
    bool points(std::initializer_list<Vec2*> points)
    {
        bool first = true;
        for (Vec2* p : points) {
            if (!std::exchange(first, false)) skipComma();
            const std::string_view begin = rest_;
            if (!numbers({&p->x(), &p->y()})) return false;
            if (relative_) *p += point_;
            if (!isFinite(*p)) return fail("coordinates that add up to less than 1.8e308", begin);
        }
        return true;
    }

    bool flag(bool& value)
    {
        skipComma();
        if (rest_.empty() || (rest_.front() != '0' && rest_.front() != '1')) return fail("an arc flag, 0 or 1,");
        value = rest_.front() == '1';
        rest_.remove_prefix(1);
        return true;
    }

    bool count(std::size_t& value, std::size_t most, std::string_view expected)
    {
        skipSpace();
        const char* end = rest_.data() + rest_.size();
        const auto [stop, problem] = std::from_chars(rest_.data(), end, value);
        if (problem != std::errc() || value > most) return fail(expected);
        rest_.remove_prefix(static_cast<std::size_t>(stop - rest_.data()));
        return true;
    }

    // --- commands

    bool command()
    {
        const char letter = rest_.front();
        const bool lower = letter >= 'a';
        const char upper = static_cast<char>(lower ? letter - 'a' + 'A' : letter);
        const bool known = std::string_view("MLHVCSQTAZ").find(upper) != std::string_view::npos;
        if (path_.isEmpty() && upper != 'M') return fail("M or m, with which a path begins,");
        if (!path_.isEmpty() && (letter == 'i' || letter == 'o' || letter == 'n')) return extension(letter);
        if (extended_ || complete_) return fail(complete_ ? "its end" : "i, o, n or its end");
        if (!known) return fail("a command (a letter of MLHVCSQTAZ)");
        rest_.remove_prefix(1);
        relative_ = lower;

        if (upper == 'Z') {
            path_.close();
            moved(path_.contours().back().segments.front().point, 'Z', {});
            return true;
        }
        skipSpace();
        char action = upper;
        do {
            if (!group(action)) return false;
            if (action == 'M') action = 'L';  // further pairs after a moveto are linetos
        } while (anotherGroup());
        return true;
    }

    /// A comma promises one; so does the beginning of a number.
    bool anotherGroup()
    {
        return skipComma() || (!rest_.empty() && std::string_view("+-.0123456789").find(rest_.front()) != rest_.npos);
    }

    void moved(const Vec2& to, char action, const Vec2& control)
    {
        point_ = to;
        previous_ = action;
        control_ = control;
    }

    bool group(char action)
    {
        switch (action) {
        case 'M':
        case 'L': return straight(action);
        case 'H':
        case 'V': return axisLine(action);
        case 'C':
        case 'S': return cubic(action);
        case 'Q':
        case 'T': return quadratic(action);
        default: return arc();
        }
    }

    bool straight(char action)
    {
        Vec2 p;
        if (!points({&p})) return false;
        action == 'M' ? path_.moveTo(p) : path_.lineTo(p);
        moved(p, action, p);
        return true;
    }

    bool axisLine(char action)
    {
        const int axis = action == 'H' ? 0 : 1;
        const std::string_view begin = rest_;
        double value = 0;
        if (!number(value)) return false;
        Vec2 p = point_;
        p[axis] = relative_ ? p[axis] + value : value;
        if (!isFinite(p)) return fail("coordinates that add up to less than 1.8e308", begin);
        path_.lineTo(p);
        moved(p, action, p);
        return true;
    }

    bool cubic(char action)
    {
        const std::string_view begin = rest_;
        Vec2 c1 = previous_ == 'C' ? Vec2(2 * point_ - control_) : point_, c2, p;
        if (!(action == 'C' ? points({&c1, &c2, &p}) : points({&c2, &p}))) return false;
        if (!isFinite(c1)) return fail("coordinates whose reflection is below 1.8e308", begin);
        path_.cubicTo(c1, c2, p);
        moved(p, 'C', c2);
        return true;
    }

    bool quadratic(char action)
    {
        const std::string_view begin = rest_;
        Vec2 c = previous_ == 'Q' ? Vec2(2 * point_ - control_) : point_, p;
        if (!(action == 'Q' ? points({&c, &p}) : points({&p}))) return false;
        const Cubic raised = Cubic::quadratic(point_, c, p);
        if (!isFinite(raised.p[1]) || !isFinite(raised.p[2]))
            return fail("coordinates whose differences are below 1.8e308", begin);
        path_.cubicTo(raised.p[1], raised.p[2], p);
        moved(p, 'Q', c);
        return true;
    }

    bool arc()
    {
        Vec2 radii, p;
        double degrees = 0;
        bool large = false, sweep = false;
        if (!numbers({&radii.x(), &radii.y(), &degrees}) || !flag(large) || !flag(sweep)) return false;
        skipComma();
        if (!points({&p})) return false;
        path_.arcTo(radii, degrees * (std::numbers::pi / 180), large, sweep, p);
        moved(p, 'A', p);
        return true;
    }

    // --- the words that SVG does not have

    bool extension(char letter)
    {
        if (complete_) return fail("its end");
        rest_.remove_prefix(1);
        (letter == 'n' ? complete_ : extended_) = true;
        return letter == 'n' ? counts() : freeHandle(letter);
    }

    bool freeHandle(char letter)
    {
        skipSpace();
        const std::string_view begin = rest_;
        std::size_t index = 0;
        Vec2 p;
        if (!count(index, path_.contours().size() - 1, "the index of an open contour")) return false;
        if (path_.contours()[index].closed) return fail("the index of an open contour", begin);
        skipSpace();
        relative_ = false;
        if (!points({&p})) return false;
        auto& segments = path_.contours()[index].segments;
        (letter == 'i' ? segments.front().in : segments.back().out) = p;
        return true;
    }

    bool counts()
    {
        static const std::string expected =
            "a count of intermediate points for each segment, at most " + std::to_string(kMaxIntermediate) + ",";
        for (Contour& contour : path_.contours())
            for (Segment& s : contour.segments) {
                std::size_t value = 0;
                if (!count(value, kMaxIntermediate, expected)) return false;
                s.intermediate = static_cast<int>(value);
            }
        return true;
    }

    std::string_view text_, rest_;
    Path path_;
    Error problem_;
    Vec2 point_;             // where the next command starts
    Vec2 control_;           // the last control point, for S and T to reflect
    char previous_ = 0;      // the command that set it: C for C and S, Q for Q and T
    bool relative_ = false;  // the current command's letter is lower case
    bool extended_ = false;  // i or o was read: only i, o and n may follow
    bool complete_ = false;  // n was read: nothing may follow
};

}  // namespace

Result<Path> Path::parse(std::string_view text)
{
    Error problem;
    Path path = parsePrefix(text, &problem);
    if (!problem.message.empty()) return problem;
    return path;
}

Path Path::parsePrefix(std::string_view text, Error* problem)
{
    Error ignored;
    return PathReader(text).read(problem ? *problem : ignored);
}

}  // namespace jet
