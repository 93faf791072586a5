#include "environment/radiance_tree.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <span>
#include <thread>

#include "math/sphere.hpp"

namespace lobe::environment {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kLeast = 32, kMost = 1024;

/// A square counts as a point where the kernel changes by less than this power of e across half of it, or
/// where what that adds to the sum, or to the sum of weights, is below these shares of the mean and of the
/// whole.
constexpr float kTolerance = 0.2F;
constexpr float kOfMean = 4e-4F, kOfWeights = 1e-3F;

int sizeFor(const EnvironmentMap& map) {
    int size = kLeast;
    while (size < kMost && size < 0.9 * map.width())
        size *= 2;
    return size;
}

float brightness(const glm::vec3& rgb) {
    return (rgb.r + rgb.g + rgb.b) / 3.0F;
}

/// From one place of a ring to the next.
constexpr float kStepCosine = 0.8660254037844387F, kStepSine = 0.5F;

/// Of squares that make up one.
RadianceTree::Node joined(std::span<const RadianceTree::Node> parts) {
    glm::vec3 bright(0.0F), plain(0.0F);
    RadianceTree::Node node{glm::vec3(0.0F), 0.0F, glm::vec3(0.0F), 0.0F};
    for (const RadianceTree::Node& part : parts) {
        node.energy += part.energy;
        node.solidAngle += part.solidAngle;
        bright += part.direction * brightness(part.energy);
        plain += part.direction * part.solidAngle;
    }
    const glm::vec3 sum = glm::length(bright) > 0.0F ? bright : plain;
    node.direction = glm::normalize(sum);
    return node;
}

}  // namespace

void inParallel(size_t count, const std::function<void(size_t)>& work) {
    std::atomic<size_t> next = 0;
    const auto run = [&] {
        for (size_t i = next++; i < count; i = next++)
            work(i);
    };
    std::vector<std::jthread> threads;
    const size_t most = std::max(1U, std::thread::hardware_concurrency());
    for (size_t i = 1; i < std::min(count, most); ++i)
        threads.emplace_back(run);
    run();
}

std::pair<int, int> foldedSquare(int x, int y, int size) {
    if (x < 0 || x >= size) {
        x = std::clamp(x, 0, size - 1);
        y = size - 1 - y;
    }
    if (y < 0 || y >= size) {
        y = std::clamp(y, 0, size - 1);
        x = size - 1 - x;
    }
    return {x, y};
}

glm::dvec3 octahedralDirection(glm::dvec2 p) {
    glm::dvec3 n(p, 1.0 - std::abs(p.x) - std::abs(p.y));
    const double fold = std::max(-n.z, 0.0);
    n.x -= n.x >= 0.0 ? fold : -fold;
    n.y -= n.y >= 0.0 ? fold : -fold;
    return glm::normalize(n);
}

RadianceTree::RadianceTree(const EnvironmentMap& map) : size_(sizeFor(map)) {
    const auto side = static_cast<size_t>(size_);
    std::vector<Node>& leaves = levels_.emplace_back(side * side);
    // Three points across each texel of the map, that no bright one is missed; more near its poles, where
    // texels are narrow.
    const int plain = std::clamp(static_cast<int>(std::ceil(1.7 * map.width() / size_)), 2, 16);
    const double narrow = std::min(12.0 * kPi / map.height(), 0.5);
    inParallel(side, [&](size_t y) {
        for (size_t x = 0; x < side; ++x) {
            glm::dvec3 energy(0.0), bright(0.0), even(0.0);
            double solidAngle = 0.0;
            const glm::dvec3 middle =
                octahedralDirection({(2.0 * static_cast<double>(x) + 1.0) / size_ - 1.0,
                                     (2.0 * static_cast<double>(y) + 1.0) / size_ - 1.0});
            const int sub = std::hypot(middle.x, middle.z) < narrow ? 4 * plain : plain;
            const double step = 2.0 / size_ / sub;
            for (int j = 0; j < sub; ++j)
                for (int i = 0; i < sub; ++i) {
                    const glm::dvec2 p(-1.0 + (static_cast<double>(x) * sub + i + 0.5) * step,
                                       -1.0 + (static_cast<double>(y) * sub + j + 0.5) * step);
                    const glm::dvec3 folded(std::abs(p.x), std::abs(p.y),
                                            1.0 - std::abs(p.x) - std::abs(p.y));
                    // The octahedron's point is at distance r: a square of the map has dA / r^3.
                    glm::dvec3 point = folded;
                    if (point.z < 0.0) point = {1.0 - folded.y, 1.0 - folded.x, folded.z};
                    const double r = glm::length(point);
                    const double part = step * step / (r * r * r);
                    const glm::dvec3 direction = octahedralDirection(p),
                                     light = map.relative(direction) * part;
                    energy += light;
                    solidAngle += part;
                    bright += direction * (light.r + light.g + light.b);
                    even += direction * part;
                }
            const glm::dvec3 sum = glm::length(bright) > 0.0 ? bright : even;
            leaves[y * side + x] = {glm::vec3(glm::normalize(sum)), 0.0F, glm::vec3(energy),
                                    static_cast<float>(solidAngle)};
        }
    });
    for (size_t n = side / 2; n >= 4; n /= 2) {
        const std::vector<Node>& below = levels_.back();
        std::vector<Node> level(n * n);
        for (size_t y = 0; y < n; ++y)
            for (size_t x = 0; x < n; ++x) {
                const size_t first = (2 * y) * (2 * n) + 2 * x;
                const std::array parts{below[first], below[first + 1], below[first + 2 * n],
                                       below[first + 2 * n + 1]};
                level[y * n + x] = joined(parts);
            }
        levels_.push_back(std::move(level));
    }
    for (size_t i = 0; i < levels_.size(); ++i) {
        const int n = size_ >> i;
        std::vector<Four>& mean = radiance_.emplace_back();
        mean.reserve(static_cast<size_t>(n + 2) * static_cast<size_t>(n + 2));
        for (int y = -1; y <= n; ++y)
            for (int x = -1; x <= n; ++x) {
                const auto [fx, fy] = foldedSquare(x, y, n);
                const Node& node =
                    levels_[i][static_cast<size_t>(fy) * static_cast<size_t>(n) + static_cast<size_t>(fx)];
                const glm::vec3 rgb = node.energy / node.solidAngle;
                mean.push_back(Four{rgb.r, rgb.g, rgb.b, 0.0F});
            }
    }
    glm::dvec3 sum(0.0);
    double sphere = 0.0;
    for (std::vector<Node>& level : levels_)
        for (Node& node : level)
            node.radius = 0.75F * std::sqrt(node.solidAngle);
    for (const Node& node : levels_.back()) {
        sum += glm::dvec3(node.energy);
        sphere += static_cast<double>(node.solidAngle);
    }
    mean_ = sum / sphere;
}

glm::vec3 RadianceTree::radiance(int x, int y) const {
    const Node& node =
        levels_.front()[static_cast<size_t>(y) * static_cast<size_t>(size_) + static_cast<size_t>(x)];
    return node.energy / node.solidAngle;
}

glm::dvec3 RadianceTree::blurred(const glm::vec3& axis, const ZonalKernel& kernel) const {
    struct Place {
        uint16_t level, x, y;
    };
    std::array<Place, 64> stack;
    size_t depth = 0;
    const auto top = static_cast<uint16_t>(levels_.size() - 1);
    const float negligible = kOfMean * brightness(glm::vec3(mean_));
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    for (uint16_t i = 0; i < 16; ++i) {
        stack[depth++] = {top, static_cast<uint16_t>(i % 4), static_cast<uint16_t>(i / 4)};
        while (depth > 0) {
            const Place at = stack[--depth];
            const size_t side = static_cast<size_t>(size_) >> at.level;
            const Node& node = levels_[at.level][at.y * side + at.x];
            const glm::vec3 away = axis - node.direction;
            const float chord2 = glm::dot(away, away);
            if (at.level > 0) {
                const ZonalKernel::Bound bound = kernel.near(chord2, node.radius);
                if (bound.value == 0.0F) continue;
                const float change = node.radius * bound.slope;
                const float error = bound.value * std::min(change * change / 6.0F, 1.0F);
                if (change > kTolerance &&
                    (error * brightness(node.energy) > negligible || error * node.solidAngle > kOfWeights)) {
                    for (int q = 0; q < 4; ++q)
                        stack[depth++] = {static_cast<uint16_t>(at.level - 1),
                                          static_cast<uint16_t>(2 * at.x + (q & 1)),
                                          static_cast<uint16_t>(2 * at.y + (q >> 1))};
                    continue;
                }
            }
            const auto weight = static_cast<double>(kernel.at(chord2));
            sum += weight * glm::dvec3(node.energy);
            weights += weight * static_cast<double>(node.solidAngle);
        }
    }
    return weights > 0.0 ? sum / weights : mean_;
}

RadianceTree::Four RadianceTree::read(size_t level, const glm::vec3& d) const {
    const int side = size_ >> level;
    const float norm = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    glm::vec2 p(d.x / norm, d.y / norm);
    if (d.z < 0.0F)
        p = {(1.0F - std::abs(d.y) / norm) * (d.x >= 0.0F ? 1.0F : -1.0F),
             (1.0F - std::abs(d.x) / norm) * (d.y >= 0.0F ? 1.0F : -1.0F)};
    // From -0.5 to side - 0.5 among the squares; the border is one before them.
    const glm::vec2 at = (p * 0.5F + 0.5F) * static_cast<float>(side) - 0.5F;
    const int x = static_cast<int>(at.x + 1.0F), y = static_cast<int>(at.y + 1.0F);
    const float s = at.x - static_cast<float>(x - 1), t = at.y - static_cast<float>(y - 1);
    const auto stride = static_cast<size_t>(side + 2);
    const Four* const row = &radiance_[level][static_cast<size_t>(y) * stride + static_cast<size_t>(x)];
    const Four above = row[0] * (1.0F - s) + row[1] * s;
    const Four below = row[stride] * (1.0F - s) + row[stride + 1] * s;
    return above * (1.0F - t) + below * t;
}

RadianceTree::Rings::Rings(const RadianceTree& tree, const ZonalKernel& kernel) : tree_(tree) {
    // Shares of the kernel, finer towards its tail, which reaches far.
    constexpr std::array kShares{0.0, 0.08, 0.2, 0.32, 0.44, 0.55, 0.66, 0.76, 0.85, 0.92, 0.965, 0.99, 1.0};
    constexpr int kSteps = 4000;
    std::array<double, kSteps + 1> chord2{}, within{};
    for (int i = 1; i <= kSteps; ++i) {
        const auto n = static_cast<size_t>(i);
        chord2[n] = std::exp2(-36.0 + 38.0 * i / kSteps);
        const double middle = 0.5 * (chord2[n] + chord2[n - 1]);
        within[n] = within[n - 1] + kPi * (chord2[n] - chord2[n - 1]) *
                                        static_cast<double>(kernel.at(static_cast<float>(middle)));
    }
    const auto at = [&](double share) {
        const auto found = std::lower_bound(within.begin(), within.end(), share * within.back());
        return chord2[static_cast<size_t>(std::min(found - within.begin(), std::ptrdiff_t{kSteps}))];
    };
    for (size_t i = 0; i + 1 < kShares.size(); ++i) {
        const double low = at(kShares[i]), high = at(kShares[i + 1] == 1.0 ? 0.9995 : kShares[i + 1]);
        const double middle = std::min(at(0.5 * (kShares[i] + kShares[i + 1])), 4.0);
        const double part = kPi * (high - low) / kAround;
        const double cosine = 1.0 - middle / 2.0;
        double level = 0.5 * std::log2(std::max(part, 1e-12) * tree.size_ * tree.size_ / (4.0 * kPi));
        level = std::clamp(std::floor(level + 0.5), 0.0, static_cast<double>(tree.levels_.size() - 1));
        const auto sine = static_cast<float>(std::sqrt(std::max(middle * (1.0 - middle / 4.0), 0.0)));
        const auto phase =
            static_cast<float>(2.0 * kPi / kAround * std::fmod(0.618034 * static_cast<double>(i), 1.0));
        Ring& ring = rings_.emplace_back(Ring{static_cast<float>(cosine),
                                              static_cast<float>(kShares[i + 1] - kShares[i]),
                                              static_cast<size_t>(level),
                                              {}});
        glm::vec2 turned(std::cos(phase), std::sin(phase));
        for (glm::vec2& place : ring.places) {
            place = sine * turned;
            turned = {turned.x * kStepCosine - turned.y * kStepSine,
                      turned.x * kStepSine + turned.y * kStepCosine};
        }
    }
}

glm::dvec3 RadianceTree::Rings::about(const glm::vec3& axis) const {
    const glm::mat3 frame(frameAbout(glm::dvec3(axis)));
    Four sum{};
    for (const Ring& ring : rings_) {
        const glm::vec3 along = ring.cosine * frame[2];
        Four part{};
        for (const glm::vec2& place : ring.places)
            part += tree_.read(ring.level, along + (place.x * frame[0] + place.y * frame[1]));
        sum += part * (ring.share / static_cast<float>(kAround));
    }
    return {double{sum[0]}, double{sum[1]}, double{sum[2]}};
}

}  // namespace lobe::environment
