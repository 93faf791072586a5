/// A weight by angle from an axis, tabulated for sums over many directions.
#pragma once

#include <array>
#include <functional>

namespace lobe::environment {

class ZonalKernel {
public:
    /// `weight`: of the angle to the axis, 0..pi, at least 0 and not 0 everywhere. Scaled to integrate to 1
    /// over the sphere.
    explicit ZonalKernel(const std::function<double(double)>& weight);

    /// Of the squared length of the difference of two unit vectors, 0..4.
    float at(float chord2) const;

    /// What bounds the kernel within `reach` of an angle: its largest value there, 1/sr, and its largest
    /// |d ln K / d angle|, 1/rad.
    struct Bound {
        float value, slope;
    };
    Bound near(float chord2, float reach) const;

    /// sqrt(2 (1 - R)), R the length of the mean direction: about the angle, in rad, within which the weight
    /// lies.
    double spread() const { return spread_; }

private:
    static constexpr int kPerOctave = 16, kOctaves = 42, kCount = kPerOctave * kOctaves;
    static float place(float chord2);
    std::array<float, kCount> value_{};
    /// Over 2^i / 16 octaves of the squared chord to each side, i from 1 on: all within reach <= kReach[i -
    /// 1] angle.
    static constexpr size_t kWindows = 5;
    static constexpr std::array<float, kWindows> kReach{0.042F, 0.083F, 0.159F, 0.293F, 0.5F};
    std::array<std::array<Bound, kCount>, kWindows> windows_{};
    std::array<Bound, kCount> upTo_{};  ///< over all angles up to this one
    double spread_ = 0.0;
};

}  // namespace lobe::environment
