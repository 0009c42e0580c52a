#include "layout.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace {

constexpr int kMostRounds = 2000;
constexpr double kStep = 0.4;   // of an overlap's depth; two boxes share it, so 0.5 would part a pair in one round
constexpr double kPull = 0.02;  // in the first round, of the way back; it fades to nothing in half the rounds

class Descent {
public:
    Descent(const std::vector<jet::Box>& boxes, double gap)
        : start_(boxes), boxes_(boxes), order_(boxes.size()), gradient_(boxes.size(), jet::Vec2(0, 0))
    {
        for (jet::Box& box : boxes_) box = box.inflated(gap / 2);
        start_ = boxes_;
        std::iota(order_.begin(), order_.end(), std::size_t{0});
    }

    /// One step down; returns the deepest overlap it found.
    double round(double pull)
    {
        std::fill(gradient_.begin(), gradient_.end(), jet::Vec2(0, 0));
        const double deepest = pushApart();
        for (std::size_t i = 0; i < boxes_.size(); ++i) {
            const jet::Vec2 home = start_[i].center() - boxes_[i].center();
            move(boxes_[i], kStep * gradient_[i] + pull * home);
        }
        return deepest;
    }

    jet::Vec2 shift(std::size_t i) const { return boxes_[i].min - start_[i].min; }

private:
    static void move(jet::Box& box, const jet::Vec2& by) { box.min += by, box.max += by; }

    /// Sweeps over x, so that far boxes are not compared.
    double pushApart()
    {
        std::sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
            return boxes_[a].min.x() != boxes_[b].min.x() ? boxes_[a].min.x() < boxes_[b].min.x() : a < b;
        });
        double deepest = 0;
        for (std::size_t i = 0; i < order_.size(); ++i)
            for (std::size_t j = i + 1; j < order_.size() && boxes_[order_[j]].min.x() < boxes_[order_[i]].max.x(); ++j)
                deepest = std::max(deepest, push(order_[i], order_[j]));
        return deepest;
    }

    /// Along the axis of least depth, which is the way of the steepest descent of that depth.
    double push(std::size_t a, std::size_t b)
    {
        const jet::Vec2 depth = (boxes_[a].max.cwiseMin(boxes_[b].max) - boxes_[a].min.cwiseMax(boxes_[b].min)).eval();
        const double least = depth.minCoeff();
        if (least <= 0) return 0;
        const int axis = depth.x() <= depth.y() ? 0 : 1;
        const double between = boxes_[b].center()[axis] - boxes_[a].center()[axis];
        // Boxes with one centre part in the order of their numbers, so that the result is the same each time.
        const double side = between != 0 ? std::copysign(1.0, between) : (a < b ? 1.0 : -1.0);
        gradient_[a][axis] -= side * least;
        gradient_[b][axis] += side * least;
        return least;
    }

    std::vector<jet::Box> start_, boxes_;
    std::vector<std::size_t> order_;
    std::vector<jet::Vec2> gradient_;
};

double largestSide(const std::vector<jet::Box>& boxes)
{
    double side = 0;
    for (const jet::Box& box : boxes) side = std::max({side, box.width(), box.height()});
    return side;
}

}  // namespace

Layout layOut(const std::vector<jet::Box>& boxes, double gap, const jet::Progress& progress)
{
    Layout layout;
    Descent descent(boxes, gap);
    const double enough = std::min(gap / 4, 1e-3 * largestSide(boxes));  // what is left lies within the gap
    for (int round = 0; round < kMostRounds && !layout.apart; ++round) {
        if (round % 16 == 0 && !progress(static_cast<double>(round) / kMostRounds)) {
            layout.cancelled = true;
            return layout;
        }
        layout.apart = descent.round(kPull * std::max(0.0, 1 - 2.0 * round / kMostRounds)) <= enough;
    }
    for (std::size_t i = 0; i < boxes.size(); ++i) layout.shifts.push_back(descent.shift(i));
    return layout;
}
