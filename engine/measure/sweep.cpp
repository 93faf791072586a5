#include "measure/sweep.hpp"

#include <algorithm>
#include <cmath>

namespace lobe::measure {
namespace {

Order compareNumbers(double a, double b) {
    return a < b ? Order::less : a > b ? Order::greater : Order::tie;
}

const Point* find(const std::vector<Point>& points, const Choice& choice) {
    for (const Point& point : points)
        if (point.choice == choice) return &point;
    return nullptr;
}

}  // namespace

Prediction::Prediction(const std::vector<int>& sizes, const Choice& base,
                       const std::vector<Point>& measured) {
    if (const Point* found = find(measured, base)) base_ = *found;
    base_.choice = base;
    for (size_t knob = 0; knob < sizes.size(); ++knob) {
        std::vector<double> factor, added;
        for (int value = 0; value < sizes[knob]; ++value) {
            Choice choice = base;
            choice[knob] = value;
            const Point* found = find(measured, choice);  // not measured: as the base
            factor.push_back(found && base_.time > 0.0 ? found->time / base_.time : 1.0);
            added.push_back(found ? found->error - base_.error : 0.0);
        }
        factor_.push_back(std::move(factor));
        added_.push_back(std::move(added));
    }
}

Point Prediction::at(const Choice& choice) const {
    Point point{choice, base_.time, base_.error};
    for (size_t knob = 0; knob < choice.size(); ++knob) {
        point.time *= factor_[knob][static_cast<size_t>(choice[knob])];
        point.error += added_[knob][static_cast<size_t>(choice[knob])];
    }
    return point;
}

Choice Prediction::best(double lambda, Choice start) const {
    const auto cost = [&](const Choice& choice) {
        const Point point = at(choice);
        return point.error + lambda * point.time;
    };
    double least = cost(start);
    for (bool better = true; better;) {
        better = false;
        for (size_t knob = 0; knob < start.size(); ++knob)
            for (size_t value = 0; value < factor_[knob].size(); ++value) {
                Choice other = start;
                other[knob] = static_cast<int>(value);
                if (const double now = cost(other); now < least) {
                    least = now;
                    start = std::move(other);
                    better = true;
                }
            }
    }
    return start;
}

Search::Search(std::vector<int> sizes, Choice base, std::vector<Choice> given,
               std::function<Choice(Choice)> canonical)
    : sizes_(std::move(sizes)), base_(std::move(base)), canonical_(std::move(canonical)) {
    base_ = canonical_(base_);
    for (const Choice& choice : given)
        suggest(choice);
    suggest(base_);
    for (size_t knob = 0; knob < sizes_.size(); ++knob)
        for (int value = 0; value < sizes_[knob]; ++value) {
            Choice choice = base_;
            choice[knob] = value;
            suggest(choice);
        }
}

void Search::suggest(const Choice& choice) {
    Choice one = canonical_(choice);
    if (suggested_.insert(one).second) queue_.push_back(std::move(one));
}

void Search::combine(const std::vector<Point>& measured) {
    const Prediction prediction(sizes_, base_, measured);
    double time = 0.0, error = 0.0;
    for (const Point& point : measured) {
        time = std::max(time, point.time);
        if (std::isfinite(point.error)) error = std::max(error, point.error);
    }
    if (time <= 0.0 || error <= 0.0) return;
    // From where only error counts to where only time does: errors of a front span many decades.
    Choice choice = base_;
    for (double exponent = -10.0; exponent <= 2.0; exponent += 0.25) {
        choice = prediction.best(error / time * std::pow(10.0, exponent), choice);
        suggest(choice);
    }
}

void Search::nearFront(const std::vector<Point>& measured) {
    std::vector<double> errors;
    for (const Point& point : measured)
        errors.push_back(point.error);
    const auto order = [&](size_t i, size_t j) { return compareNumbers(measured[i].time, measured[j].time); };
    for (const size_t i : paretoFront(errors, order))
        for (size_t knob = 0; knob < sizes_.size(); ++knob)
            for (const int step : {-1, 1}) {
                Choice choice = measured[i].choice;
                choice[knob] += step;
                if (choice[knob] >= 0 && choice[knob] < sizes_[knob]) suggest(choice);
            }
}

std::optional<Choice> Search::next(const std::vector<Point>& measured) {
    if (queue_.empty() && !combined_) {
        combined_ = true;
        combine(measured);
    }
    if (queue_.empty()) nearFront(measured);
    if (queue_.empty()) return {};
    Choice choice = std::move(queue_.front());
    queue_.pop_front();
    return choice;
}

double Search::possible() const {
    double count = 1.0;
    for (const int size : sizes_)
        count *= size;
    return count;
}

std::vector<size_t> paretoFront(const std::vector<double>& errors,
                                const std::function<Order(size_t, size_t)>& order, double floor) {
    std::vector<size_t> front;
    const auto error = [&](size_t i) { return std::max(errors[i], floor); };
    for (size_t i = 0; i < errors.size(); ++i) {
        const bool beaten = [&] {
            for (size_t j = 0; j < errors.size(); ++j) {
                if (j == i) continue;
                const Order time = order(j, i);
                const Order wrong = compareNumbers(error(j), error(i));
                if (time != Order::greater && wrong != Order::greater &&
                    (time == Order::less || wrong == Order::less))
                    return true;
            }
            return false;
        }();
        if (!beaten) front.push_back(i);
    }
    return front;
}

}  // namespace lobe::measure
