/// Which settings are worth measuring, without trying them all.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "measure/statistics.hpp"

namespace lobe::measure {

/// Index into the values of each knob.
using Choice = std::vector<int>;

/// A choice that was measured.
struct Point {
    Choice choice;
    double time = 0.0;   ///< any unit, above 0
    double error = 0.0;  ///< one that adds up over independent causes: a mean square
};

/// Suggests one choice after the other:
/// 1. those given (presets), then each knob alone away from the base;
/// 2. from the times and errors of these, combinations that minimise error + lambda time, for values of one
///    multiplier lambda over all knobs (Shoham and Gersho, 1988). Predicted: each knob multiplies the base's
///    time by a factor of its own, and adds to its error;
/// 3. neighbours of the front of what was measured, by one step of one knob.
/// Nothing is suggested twice.
class Search {
public:
    /// `sizes`: how many values each knob has. `canonical` gives, of choices that make the same picture in
    /// the same time, always the same one.
    Search(std::vector<int> sizes, Choice base, std::vector<Choice> given,
           std::function<Choice(Choice)> canonical);

    /// The next one, with all that were measured so far; none when all is tried that is worth it.
    std::optional<Choice> next(const std::vector<Point>& measured);

    /// Choices that differ.
    double possible() const;

private:
    void suggest(const Choice& choice);
    void combine(const std::vector<Point>& measured);
    void nearFront(const std::vector<Point>& measured);

    std::vector<int> sizes_;
    Choice base_;
    std::function<Choice(Choice)> canonical_;
    std::deque<Choice> queue_;
    std::set<Choice> suggested_;
    bool combined_ = false;
};

/// The model of step 2, from a base and what changes with each knob alone.
class Prediction {
public:
    Prediction(const std::vector<int>& sizes, const Choice& base, const std::vector<Point>& measured);
    Point at(const Choice& choice) const;
    /// The choice of least error + lambda time that turning one knob after the other comes to from `start`.
    Choice best(double lambda, Choice start) const;

private:
    Point base_;
    std::vector<std::vector<double>> factor_, added_;  ///< by knob and value
};

/// Indices of what no other beats: is less in one of time and error and not more in the other. `order(i, j)`
/// compares times and calls a tie what noise hides. Errors at or below `floor` count as equal: the truth
/// itself is no better known.
std::vector<size_t> paretoFront(const std::vector<double>& errors,
                                const std::function<Order(size_t, size_t)>& order, double floor = 0.0);

}  // namespace lobe::measure
