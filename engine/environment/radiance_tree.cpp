#include "environment/radiance_tree.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <span>
#include <thread>

namespace lobe::environment {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kLeast = 32, kMost = 1024;

/// How far a kernel may change, as a power of e, across half of a square that counts as a point.
constexpr float kTolerance = 0.6F;
/// Of the mean of the whole sum, below which the light of a square counts as at one place.
constexpr float kNegligible = 2e-5F;

int sizeFor(const EnvironmentMap& map) {
    int size = kLeast;
    while (size < kMost && size < 0.6 * map.width())
        size *= 2;
    return size;
}

float brightness(const glm::vec3& rgb) {
    return (rgb.r + rgb.g + rgb.b) / 3.0F;
}

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
    // Three points for each texel of the map, that no bright one is missed.
    const int sub = std::clamp(static_cast<int>(std::ceil(1.7 * map.width() / size_)), 2, 16);
    const double step = 2.0 / size_ / sub;
    inParallel(side, [&](size_t y) {
        for (size_t x = 0; x < side; ++x) {
            glm::dvec3 energy(0.0), bright(0.0), plain(0.0);
            double solidAngle = 0.0;
            for (int j = 0; j < sub; ++j)
                for (int i = 0; i < sub; ++i) {
                    const glm::dvec2 p(-1.0 + (static_cast<double>(x) * sub + i + 0.5) * step,
                                       -1.0 + (static_cast<double>(y) * sub + j + 0.5) * step);
                    const glm::dvec3 folded(std::abs(p.x), std::abs(p.y), 1.0 - std::abs(p.x) - std::abs(p.y));
                    // The octahedron's point is at distance r: a square of the map has dA / r^3.
                    glm::dvec3 point = folded;
                    if (point.z < 0.0) point = {1.0 - folded.y, 1.0 - folded.x, folded.z};
                    const double r = glm::length(point);
                    const double part = step * step / (r * r * r);
                    const glm::dvec3 direction = octahedralDirection(p), light = map.relative(direction) * part;
                    energy += light;
                    solidAngle += part;
                    bright += direction * (light.r + light.g + light.b);
                    plain += direction * part;
                }
            const glm::dvec3 sum = glm::length(bright) > 0.0 ? bright : plain;
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
    const Node& node = levels_.front()[static_cast<size_t>(y) * static_cast<size_t>(size_) + static_cast<size_t>(x)];
    return node.energy / node.solidAngle;
}

glm::dvec3 RadianceTree::blurred(const glm::vec3& axis, const ZonalKernel& kernel) const {
    struct Place {
        uint16_t level, x, y;
    };
    std::array<Place, 64> stack;
    size_t depth = 0;
    const auto top = static_cast<uint16_t>(levels_.size() - 1);
    const float negligible = kNegligible * brightness(glm::vec3(mean_));
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
                if (node.radius * bound.slope > kTolerance &&
                    (bound.value * brightness(node.energy) > negligible ||
                     bound.value * node.solidAngle > kNegligible)) {
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

}  // namespace lobe::environment
