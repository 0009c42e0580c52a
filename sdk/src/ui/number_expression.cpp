// Recursive descent over the grammar in the header.
#include <jet/ui/number_expression.hpp>

#include <jet/value.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace jet::ui {

namespace {

constexpr std::size_t kLongest = 1000;  // characters: who needs more needs a calculator
constexpr int kDeepest = 100;

struct Unit {
    std::string_view of, name;  // the field's unit, and what may be typed there
    double factor;              // in the field's units
};

constexpr double kPixelsAnInch = 96;
constexpr std::array kUnits{
    Unit{"units", "px", 1},
    Unit{"units", "mm", kPixelsAnInch / 25.4},
    Unit{"units", "cm", kPixelsAnInch / 2.54},
    Unit{"units", "m", kPixelsAnInch / 0.0254},
    Unit{"units", "in", kPixelsAnInch},
    Unit{"units", "pt", kPixelsAnInch / 72},
    Unit{"units", "pc", kPixelsAnInch / 6},
    Unit{"units", "unit", 1},
    Unit{"rad", "deg", std::numbers::pi / 180},
    Unit{"rad", "°", std::numbers::pi / 180},
    Unit{"rad", "turn", 2 * std::numbers::pi},
    Unit{"s", "ms", 1e-3},
    Unit{"s", "min", 60},
    Unit{"kg", "g", 1e-3},
    Unit{"kg", "t", 1e3},
};

using Function = double (*)(double);
struct NamedFunction {
    std::string_view name;
    Function call;
};
const std::array kFunctions{
    NamedFunction{"sqrt", [](double v) { return std::sqrt(v); }},
    NamedFunction{"abs", [](double v) { return std::abs(v); }},
    NamedFunction{"sin", [](double v) { return std::sin(v); }},
    NamedFunction{"cos", [](double v) { return std::cos(v); }},
    NamedFunction{"tan", [](double v) { return std::tan(v); }},
    NamedFunction{"asin", [](double v) { return std::asin(v); }},
    NamedFunction{"acos", [](double v) { return std::acos(v); }},
    NamedFunction{"atan", [](double v) { return std::atan(v); }},
    NamedFunction{"exp", [](double v) { return std::exp(v); }},
    NamedFunction{"ln", [](double v) { return std::log(v); }},
    NamedFunction{"log", [](double v) { return std::log10(v); }},
    NamedFunction{"round", [](double v) { return std::round(v); }},
    NamedFunction{"floor", [](double v) { return std::floor(v); }},
    NamedFunction{"ceil", [](double v) { return std::ceil(v); }},
};

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// With points for decimal commas.
std::string withPoints(std::string_view text)
{
    std::string result(text);
    for (std::size_t i = 0; i + 1 < result.size(); ++i)
        if (result[i] == ',' && isDigit(result[i + 1])) result[i] = '.';
    return result;
}

class Reader {
public:
    Reader(std::string_view text, const NumberContext& context) : text_(text), rest_(text), context_(context) {}

    double read()
    {
        const double value = sum();
        skipSpace();
        if (!rest_.empty()) fail("\"" + std::string(rest_.substr(0, 20)) + "\" has no meaning here");
        if (!std::isfinite(value)) fail("The result is not a number that can be used");
        return value;
    }

private:
    [[noreturn]] void fail(const std::string& message) const
    {
        const int column = static_cast<int>(text_.size() - rest_.size()) + 1;
        throw Failure(Error(message + ".", Location{{}, 1, column}));
    }

    void skipSpace()
    {
        while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t')) rest_.remove_prefix(1);
    }

    bool take(std::string_view token)
    {
        skipSpace();
        if (!rest_.starts_with(token)) return false;
        rest_.remove_prefix(token.size());
        return true;
    }

    std::string_view word() const
    {
        return rest_.substr(0, static_cast<std::size_t>(std::ranges::find_if_not(rest_, isLetter) - rest_.begin()));
    }

    double sum()
    {
        double value = product();
        for (;;) {
            if (take("+")) {
                value += product();
            } else if (take("-") || take("−")) {
                value -= product();
            } else {
                return value;
            }
        }
    }

    double product()
    {
        double value = power();
        for (;;) {
            if (take("*") || take("×") || take("·")) {
                value *= power();
            } else if (take("/") || take("÷")) {
                const double divisor = power();
                if (divisor == 0) fail("A division by zero has no result");
                value /= divisor;
            } else {
                return value;
            }
        }
    }

    double power()
    {
        const Depth deeper(*this);
        const double base = sign();
        return take("^") ? std::pow(base, power()) : base;
    }

    double sign()
    {
        const Depth deeper(*this);
        if (take("-") || take("−")) return -sign();
        if (take("+")) return sign();
        return suffixed(primary());
    }

    double primary()
    {
        skipSpace();
        if (take("(")) return closed();
        double value = 0;
        if (!rest_.empty() && (isDigit(rest_.front()) || rest_.front() == '.')) {
            if (!readNumber(rest_, value)) fail("A number should be here");
            return value;
        }
        const std::string_view name = word();
        if (name.empty()) fail(rest_.empty() ? "The expression ends too early" : "A number should be here");
        if (const auto* found = std::ranges::find(kFunctions, name, &NamedFunction::name); found != kFunctions.end()) {
            rest_.remove_prefix(name.size());
            if (!take("(")) fail("After \"" + std::string(name) + "\" there should be a value in brackets");
            return found->call(closed());
        }
        return constant(name);
    }

    double closed()
    {
        const double value = sum();
        if (!take(")")) fail("A closing bracket is missing");
        return value;
    }

    double constant(std::string_view name)
    {
        std::optional<double> value;
        if (name == "pi") value = std::numbers::pi;
        if (name == "tau") value = 2 * std::numbers::pi;
        if (name == "e") value = std::numbers::e;
        if (name == "x") value = present();
        if (!value) fail("\"" + std::string(name) + "\" is not known here");
        rest_.remove_prefix(name.size());
        return *value;
    }

    double present() const
    {
        if (!context_.present) fail("The present values differ, so they cannot be used here");
        return *context_.present;
    }

    double suffixed(double value)
    {
        skipSpace();
        if (take("%")) return value / 100 * present();
        if (!context_.unit.empty() && rest_.starts_with(context_.unit)) {
            const std::string_view after = rest_.substr(context_.unit.size());
            if (after.empty() || !isLetter(after.front())) {
                rest_ = after;
                return value;
            }
        }
        const std::string_view name = rest_.starts_with("°") ? std::string_view("°") : word();
        if (name.empty()) return value;
        for (const Unit& unit : kUnits) {
            if (unit.of != context_.unit || unit.name != name) continue;
            rest_.remove_prefix(name.size());
            return value * unit.factor;
        }
        fail(unitsMessage(name));
    }

    std::string unitsMessage(std::string_view name) const
    {
        std::string message = "\"" + std::string(name) + "\" is no unit of this field";
        if (context_.unit.empty()) return message + ", which is a plain number";
        message += "; it takes " + context_.unit;
        for (const Unit& unit : kUnits)
            if (unit.of == context_.unit) message += ", " + std::string(unit.name);
        return message;
    }

    struct Depth {
        explicit Depth(Reader& r) : reader(r)
        {
            if (++reader.depth_ > kDeepest) reader.fail("The expression is nested too deep");
        }
        ~Depth() { --reader.depth_; }
        Depth(const Depth&) = delete;
        Depth& operator=(const Depth&) = delete;
        Reader& reader;
    };

    std::string_view text_, rest_;
    const NumberContext& context_;
    int depth_ = 0;
};

}  // namespace

Result<double> evaluateNumber(std::string_view text, const NumberContext& context)
{
    if (text.size() > kLongest) return Error("The expression is longer than 1000 characters.");
    const std::string plain = withPoints(text);
    try {
        return Reader(plain, context).read();
    } catch (const Failure& failure) {
        return failure.error();
    }
}

}  // namespace jet::ui
