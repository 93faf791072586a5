#include "shading/merl.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/gtc/constants.hpp>
#include <string>

#include "base/error.hpp"

namespace lobe::shading {
namespace {

static_assert(std::endian::native == std::endian::little, "MERL files are little-endian");

const double kHalfPi = glm::half_pi<double>();
const std::array<double, 3> kChannelScale{1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};
constexpr size_t kHeaderBytes = 12;
constexpr size_t kMostCells = size_t{1} << 24;

Directions centre(const MerlSize& size, size_t h, size_t d, size_t p) {
    const double th = (static_cast<double>(h) + 0.5) / static_cast<double>(size.thetaH);
    return fromHalfAndDifference(
        kHalfPi * th * th, kHalfPi * (static_cast<double>(d) + 0.5) / static_cast<double>(size.thetaD),
        glm::pi<double>() * (static_cast<double>(p) + 0.5) / static_cast<double>(size.phiD));
}

/// Integral of f_r cos over the hemisphere for light along the normal, where theta_h = theta_d = theta / 2
/// and phi_d = 0 or pi; by the midpoint rule on 512 angles.
glm::dvec3 normalAlbedo(const MerlSize& size, const TableRows& rows) {
    glm::dvec3 sum(0.0);
    constexpr int kAngles = 512;
    for (int i = 0; i < kAngles; ++i) {
        const double theta = kHalfPi * (i + 0.5) / kAngles;
        const auto index = [](double x, size_t n) {
            return std::min(static_cast<size_t>(x * static_cast<double>(n)), n - 1);
        };
        const size_t h = index(std::sqrt(theta / 2.0 / kHalfPi), size.thetaH);
        const size_t d = index(theta / 2.0 / kHalfPi, size.thetaD);
        const size_t cell = 4 * (2 + size.phiD * (d + size.thetaD * h));
        sum += glm::dvec3(rows[cell], rows[cell + 1], rows[cell + 2]) * (std::cos(theta) * std::sin(theta));
    }
    return sum * (glm::two_pi<double>() * kHalfPi / kAngles);
}

TableRows finished(const MerlSize& size, TableRows rows) {
    rows[0] = static_cast<double>(size.thetaH);
    rows[1] = static_cast<double>(size.thetaD);
    rows[2] = static_cast<double>(size.phiD);
    const glm::dvec3 albedo = normalAlbedo(size, rows);
    for (int c = 0; c < 3; ++c)
        rows[static_cast<size_t>(4 + c)] = albedo[c];
    return rows;
}

MerlSize sizeOf(std::span<const std::byte> file) {
    if (file.size() < kHeaderBytes)
        throw InputError(std::to_string(file.size()) +
                         " bytes; expected a MERL table, which starts with 12 bytes of sizes");
    std::array<int32_t, 3> stored{};
    std::memcpy(stored.data(), file.data(), kHeaderBytes);
    for (const int32_t n : stored)
        if (n < 1 || n > 4096)
            throw InputError("size " + std::to_string(n) +
                             " in the first 12 bytes; expected 1..4096, usually 90, 90, 180");
    const MerlSize size{static_cast<size_t>(stored[0]), static_cast<size_t>(stored[1]),
                        static_cast<size_t>(stored[2])};
    if (size.cells() > kMostCells)
        throw InputError(std::to_string(size.cells()) + " cells; expected at most " +
                         std::to_string(kMostCells));
    const size_t expected = kHeaderBytes + size.cells() * 3 * sizeof(double);
    if (file.size() != expected)
        throw InputError(std::to_string(file.size()) + " bytes; expected " + std::to_string(expected) +
                         " for " + std::to_string(size.thetaH) + " x " + std::to_string(size.thetaD) + " x " +
                         std::to_string(size.phiD) + " cells");
    return size;
}

}  // namespace

Directions fromHalfAndDifference(double thetaH, double thetaD, double phiD) {
    const glm::dvec3 difference(std::sin(thetaD) * std::cos(phiD), std::sin(thetaD) * std::sin(phiD),
                                std::cos(thetaD));
    const double c = std::cos(thetaH), s = std::sin(thetaH);
    const glm::dvec3 wi(c * difference.x + s * difference.z, difference.y,
                        -s * difference.x + c * difference.z);
    const glm::dvec3 h(s, 0.0, c);
    return {wi, 2.0 * glm::dot(wi, h) * h - wi};
}

TableRows merlTable(std::span<const std::byte> file) {
    const MerlSize size = sizeOf(file);
    const size_t cells = size.cells();
    TableRows rows(4 * (cells + 2), 0.0);
    for (size_t channel = 0; channel < 3; ++channel) {
        const std::byte* from = file.data() + kHeaderBytes + channel * cells * sizeof(double);
        for (size_t i = 0; i < cells; ++i) {
            double value;
            std::memcpy(&value, from + i * sizeof(double), sizeof value);
            constexpr double kLargest = 1e30;
            if (!(std::abs(value) <= kLargest))
                throw InputError("value " + std::to_string(i) + " of channel " + std::to_string(channel) +
                                 ": " + (std::isnan(value) ? "NaN" : std::to_string(value)) +
                                 "; expected a finite number");
            rows[4 * (i + 2) + channel] = std::max(value, 0.0) * kChannelScale[channel];
        }
    }
    return finished(size, std::move(rows));
}

TableRows tabulated(const MerlSize& size, const std::function<glm::dvec3(const Directions&)>& reflectance) {
    TableRows rows(4 * (size.cells() + 2), 0.0);
    size_t cell = 2;
    for (size_t h = 0; h < size.thetaH; ++h)
        for (size_t d = 0; d < size.thetaD; ++d)
            for (size_t p = 0; p < size.phiD; ++p, ++cell) {
                const glm::dvec3 f = reflectance(centre(size, h, d, p));
                for (int c = 0; c < 3; ++c)
                    rows[4 * cell + static_cast<size_t>(c)] = f[c];
            }
    return finished(size, std::move(rows));
}

}  // namespace lobe::shading
