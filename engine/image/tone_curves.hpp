/// The tone curves as inlinable functions without branches, for loops over pixels. Linear Rec.709 in and out;
/// inputs 0..kBrightest, outputs may leave 0..1 by what a fit's tails and gamut conversion do: the caller
/// clamps.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace lobe::curves {

/// Every curve is flat to float precision up here, and squares do not overflow.
inline constexpr float kBrightest = 1e9F;

struct Rgb {
    float r, g, b;
};

/// One instruction each, where std::min and std::max with their references become branches. NaN in `x` gives
/// `y`.
inline float larger(float x, float y) {
    return x > y ? x : y;
}
inline float smaller(float x, float y) {
    return x < y ? x : y;
}

/// NaN becomes 0.
inline float clamp01(float x) {
    return smaller(larger(x, 0.0F), 1.0F);
}

using Matrix = std::array<std::array<double, 3>, 3>;

constexpr Matrix inverse(const Matrix& m) {
    Matrix adjoint{};
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j) {
            const size_t a = (j + 1) % 3;
            const size_t b = (j + 2) % 3;
            const size_t c = (i + 1) % 3;
            const size_t d = (i + 2) % 3;
            adjoint[i][j] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
        }
    const double determinant = m[0][0] * adjoint[0][0] + m[0][1] * adjoint[1][0] + m[0][2] * adjoint[2][0];
    for (auto& row : adjoint)
        for (double& value : row)
            value /= determinant;
    return adjoint;
}

constexpr Matrix product(const Matrix& a, const Matrix& b) {
    Matrix result{};
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j)
            for (size_t k = 0; k < 3; ++k)
                result[i][j] += a[i][k] * b[k][j];
    return result;
}

template<const Matrix& m>
inline Rgb transform(Rgb c) {
    constexpr auto row = [](size_t i) {
        return Rgb{static_cast<float>(m[i][0]), static_cast<float>(m[i][1]), static_cast<float>(m[i][2])};
    };
    constexpr Rgb x = row(0);
    constexpr Rgb y = row(1);
    constexpr Rgb z = row(2);
    return {x.r * c.r + x.g * c.g + x.b * c.b, y.r * c.r + y.g * c.g + y.b * c.b,
            z.r * c.r + z.g * c.g + z.b * c.b};
}

/// log2 for normal x > 0, absolute error below 3e-7 + 1e-7 |log2 x|: mantissa in [sqrt(1/2), sqrt(2)), artanh
/// series.
inline float log2Fast(float x) {
    constexpr uint32_t kSqrtHalf = 0x3f3504f3;
    const uint32_t bits = std::bit_cast<uint32_t>(x) - kSqrtHalf;
    const auto exponent = static_cast<float>(static_cast<int32_t>(bits) >> 23);
    const auto mantissa = std::bit_cast<float>((bits & 0x007fffffU) + kSqrtHalf);
    const float s = (mantissa - 1.0F) / (mantissa + 1.0F);
    const float s2 = s * s;
    constexpr float kScale = 2.8853900817779268F;  // 2 / ln 2
    const float series = 1.0F + s2 * (1.0F / 3 + s2 * (1.0F / 5 + s2 * (1.0F / 7 + s2 * (1.0F / 9))));
    return exponent + kScale * s * series;
}

/// 2^y for y in -120..0.6, relative error below 3e-7: Taylor's series about the nearest integer.
inline float exp2Fast(float y) {
    const auto whole = static_cast<int32_t>(y - 0.5F);
    const float f = (y - static_cast<float>(whole)) * 0.6931471805599453F;
    const float series =
        1.0F +
        f * (1.0F +
             f * (1.0F / 2 + f * (1.0F / 6 + f * (1.0F / 24 +
                                                  f * (1.0F / 120 + f * (1.0F / 720 + f * (1.0F / 5040)))))));
    return series * std::bit_cast<float>((whole + 127) << 23);
}

/// Reinhard et al., "Photographic Tone Reproduction for Digital Images", 2002, eq. 3, on the luminance of
/// Rec.709.
inline Rgb reinhard(Rgb c) {
    const float luminance = 0.2126F * c.r + 0.7152F * c.g + 0.0722F * c.b;
    const float scale = 1.0F / (1.0F + luminance);
    return {c.r * scale, c.g * scale, c.b * scale};
}

/// Rec.709 to the working space of ACES' RRT with its desaturation, and back (Stephen Hill's fit of RRT and
/// ODT).
inline constexpr Matrix kAcesIn = {
    {{.59719, .35458, .04823}, {.07600, .90834, .01566}, {.02840, .13383, .83777}}};
inline constexpr Matrix kAcesOut = {
    {{1.60475, -.53108, -.07367}, {-.10208, 1.10813, -.00605}, {-.00327, -.07276, 1.07602}}};

inline Rgb aces(Rgb c) {
    const auto fit = [](float v) {
        return (v * (v + .0245786F) - .000090537F) / (v * (.983729F * v + .4329510F) + .238081F);
    };
    const Rgb v = transform<kAcesIn>(c);
    return transform<kAcesOut>({fit(v.r), fit(v.g), fit(v.b)});
}

/// AgX (Troy Sobotka), base look, in Rec.2020 primaries; the sigmoid is the polynomial of Benjamin Wrensch.
inline constexpr Matrix k2020To709 = {
    {{1.6605, -.5876, -.0728}, {-.1246, 1.1329, -.0083}, {-.0182, -.1006, 1.1187}}};
inline constexpr Matrix kAgxInset = {
    {{.856627, .095121, .048252}, {.137319, .761242, .101439}, {.111898, .076799, .811302}}};
inline constexpr Matrix kAgxOutsetInverse = {
    {{.899797, .087200, .013003}, {.111421, .875576, .013003}, {.111421, .087200, .801379}}};
inline constexpr Matrix kAgxIn = product(kAgxInset, inverse(k2020To709));
inline constexpr Matrix kAgxOut = inverse(kAgxOutsetInverse);

inline Rgb agx(Rgb c) {
    constexpr float kMinimum =
        -12.47393F;  // log2 of the darkest and brightest value that the curve tells apart
    constexpr float kMaximum = 4.026069F;
    const auto sigmoid = [](float v) {
        const float x = clamp01((log2Fast(larger(v, 1e-10F)) - kMinimum) * (1.0F / (kMaximum - kMinimum)));
        return ((((((15.5F * x - 40.14F) * x + 31.96F) * x - 6.868F) * x + .4298F) * x + .1191F) * x) -
               .00232F;
    };
    const auto power = [](float v) { return exp2Fast(2.2F * log2Fast(larger(v, 1e-10F))); };
    const Rgb v = transform<kAgxIn>(c);
    const Rgb display = transform<kAgxOut>({sigmoid(v.r), sigmoid(v.g), sigmoid(v.b)});
    return transform<k2020To709>({power(display.r), power(display.g), power(display.b)});
}

/// Khronos PBR Neutral Tone Mapper.
inline Rgb neutral(Rgb c) {
    constexpr float kF90 = .04F;
    constexpr float kStart = .8F - kF90;
    constexpr float kDesaturation = .15F;
    const float least = smaller(c.r, smaller(c.g, c.b));
    const float fresnel = least < 2 * kF90 ? least - least * least / (4 * kF90) : kF90;
    const Rgb d{c.r - fresnel, c.g - fresnel, c.b - fresnel};
    const float peak = larger(d.r, larger(d.g, d.b));
    // Below kStart the new peak is the old one, and the mixture keeps all of the colour.
    const float over = larger(peak, kStart);
    const float squeezed = 1.0F - (1.0F - kStart) * (1.0F - kStart) / (over + 1.0F - 2 * kStart);
    const float scale = squeezed / over;
    const float keep = 1.0F / (kDesaturation * (over - squeezed) + 1.0F);
    const auto mix = [=](float v) { return peak > kStart ? v * scale * keep + squeezed * (1.0F - keep) : v; };
    return {mix(d.r), mix(d.g), mix(d.b)};
}

}  // namespace lobe::curves
