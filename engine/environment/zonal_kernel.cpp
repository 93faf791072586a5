#include "environment/zonal_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lobe::environment {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFirst = -40.0;  ///< log2 of the least squared chord

double angleOf(double chord2) {
    return 2.0 * std::asin(std::min(std::sqrt(chord2) / 2.0, 1.0));
}

}  // namespace

float ZonalKernel::place(float chord2) {
    const float octave = std::log2(std::max(chord2, 1e-12F)) - static_cast<float>(kFirst);
    return std::clamp(octave * kPerOctave, 0.0F, static_cast<float>(kCount - 1));
}

ZonalKernel::ZonalKernel(const std::function<double(double)>& weight) {
    std::array<double, kCount> angle{}, value{};
    for (size_t i = 0; i < kCount; ++i) {
        angle[i] = angleOf(std::exp2(kFirst + static_cast<double>(i) / kPerOctave));
        value[i] = std::max(weight(angle[i]), 0.0);
    }
    // Of d(cos) = d(chord^2) / 2, from the axis on.
    double sum = 0.0, along = 0.0, last = 0.0, lastValue = value[0];
    for (size_t i = 0; i < kCount; ++i) {
        const double chord2 = std::min(std::exp2(kFirst + static_cast<double>(i) / kPerOctave), 4.0);
        const double part = kPi * (chord2 - last) * 0.5 * (value[i] + lastValue);
        sum += part;
        along += part * 0.5 * (chord2 + last) / 2.0;  // of 1 - cos
        last = chord2;
        lastValue = value[i];
    }
    spread_ = std::sqrt(std::max(2.0 * along / sum, 0.0));
    std::array<Bound, kCount> own{};
    for (size_t i = 0; i < kCount; ++i) {
        value_[i] = static_cast<float>(value[i] / sum);
        const size_t next = std::min<size_t>(i + 1, kCount - 1);
        double slope = 0.0;
        if (next > i && angle[next] > angle[i] && value[i] != value[next]) {
            constexpr double kSteepest = 60.0;  // where a kernel ends, what it still has is small
            const double width = std::max(angle[next] - angle[i], 1e-12);
            slope = value[i] > 0.0 && value[next] > 0.0 ? std::abs(std::log(value[next] / value[i])) / width
                                                        : kSteepest / std::max(angle[i], 0.05);
            slope = std::min(slope, std::max(kSteepest, kSteepest * 0.2 / angle[i]));
        }
        own[i] = {value_[i], static_cast<float>(slope)};
    }
    const auto grow = [](Bound& bound, const Bound& other) {
        bound.value = std::max(bound.value, other.value);
        bound.slope = std::max(bound.slope, other.slope);
    };
    Bound all{0.0F, 0.0F};
    for (size_t i = 0; i < kCount; ++i) {
        grow(all, own[i]);
        upTo_[i] = all;
        for (size_t w = 0; w < kWindows; ++w) {
            const size_t reach = (size_t{2} << w) + 1;
            for (size_t j = i - std::min(i, reach); j <= std::min<size_t>(i + reach, kCount - 1); ++j)
                grow(windows_[w][i], own[j]);
        }
    }
}

float ZonalKernel::at(float chord2) const {
    const float x = place(chord2);
    const auto i = std::min(static_cast<size_t>(x), static_cast<size_t>(kCount - 2));
    const float t = x - static_cast<float>(i);
    return value_[i] + t * (value_[i + 1] - value_[i]);
}

ZonalKernel::Bound ZonalKernel::near(float chord2, float reach) const {
    for (size_t w = 0; w < kWindows; ++w)
        if (reach * reach <= kReach[w] * kReach[w] * chord2)
            return windows_[w][static_cast<size_t>(place(chord2))];
    const float far = std::sqrt(chord2) + reach;
    return upTo_[std::min(static_cast<size_t>(place(far * far)) + 1, static_cast<size_t>(kCount - 1))];
}

}  // namespace lobe::environment
