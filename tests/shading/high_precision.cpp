#include "high_precision.hpp"

#include <algorithm>
#include <array>
#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <vector>

namespace lobe::test {
namespace {

using Real = boost::multiprecision::cpp_bin_float_50;

const Real kPi = boost::math::constants::pi<Real>();

/// exp(-x), 0 where it is far below the range of doubles.
Real decay(const Real& x) {
    return x > 2000 ? Real(0) : Real(exp(-x));
}

Real square(const Real& x) {
    return x * x;
}

struct Vector {
    Real x, y, z;
};

Real dot(const Vector& a, const Vector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

Vector scaled(const Vector& v, const Real& by) {
    return {v.x * by, v.y * by, v.z * by};
}

Vector unit(const Vector& v) {
    return scaled(v, 1 / sqrt(dot(v, v)));
}

/// What formulas name: the directions, H, and the cosines between them.
struct Geometry {
    Vector l, v, h;
    Real nl, nv, nh, vh, lv;

    explicit Geometry(const Directions& d)
        : l(unit({d.wi.x, d.wi.y, d.wi.z})), v(unit({d.wo.x, d.wo.y, d.wo.z})) {
        h = unit({l.x + v.x, l.y + v.y, l.z + v.z});
        nl = l.z;
        nv = v.z;
        nh = h.z;
        vh = dot(v, h);
        lv = dot(l, v);
    }
    Real tan2H() const { return (1 - nh * nh) / (nh * nh); }
};

/// Components of `w` along axes turned about the normal by `angle`.
Vector turned(const Vector& w, double angle) {
    const Real c = cos(Real(angle)), s = sin(Real(angle));
    return {c * w.x + s * w.y, c * w.y - s * w.x, w.z};
}

/// One channel of the reflectance of an interface of index eta + i k (Born and Wolf): moduli of the
/// amplitudes, with the refracted wave's cosine times the index as a + i b.
Real exactFresnel(const Real& eta, const Real& k, const Real& c) {
    const Real s2 = 1 - c * c;
    const Real t = eta * eta - k * k - s2;
    const Real modulus = sqrt(t * t + 4 * square(eta * k));
    const Real a2 = (modulus + t) / 2, b2 = (modulus - t) / 2;
    const Real a = sqrt(std::max(a2, Real(0)));
    const Real rs = (square(a - c) + b2) / (square(a + c) + b2);
    const Real rp = rs * (square(a * c - s2) + b2 * c * c) / (square(a * c + s2) + b2 * c * c);
    return (rs + rp) / 2;
}

Real schlick(const Real& f0, const Real& c) {
    return f0 + (1 - f0) * pow(1 - c, 5);
}

Real fresnel(std::span<const double> values, size_t channel, const Real& c) {
    if (values[0] == 0.0) return schlick(values[1 + channel], c);
    return exactFresnel(values[4 + channel], values[0] == 2.0 ? Real(values[7 + channel]) : Real(0), c);
}

/// `f` of each channel, times cos(theta_i).
glm::dvec3 perChannel(const Directions& d, const std::function<Real(const Geometry&, size_t)>& f) {
    const Geometry g(d);
    glm::dvec3 result;
    for (size_t c = 0; c < 3; ++c)
        result[static_cast<int>(c)] = static_cast<double>(f(g, c) * g.nl);
    return result;
}

/// k_d / pi + k_s F lobe, Fresnel's values last.
glm::dvec3 microfacet(const Directions& d, std::span<const double> values,
                      const std::function<Real(const Geometry&)>& lobe) {
    const Real common = lobe(Geometry(d));
    return perChannel(d, [&](const Geometry& g, size_t c) -> Real {
        return values[c] / kPi + values[3 + c] * fresnel(values.last(10), c, g.vh) * common;
    });
}

Real beckmann(const Geometry& g, const Real& m) {
    return decay(g.tan2H() / (m * m)) / (kPi * m * m * pow(g.nh, 4));
}

Real beckmannLambda(const Real& cosine, const Real& m) {
    const Real tangent = sqrt(1 - cosine * cosine) / cosine;
    if (tangent == 0) return 0;
    const Real x = 1 / (m * tangent);
    if (x > 100) return 0;  // below exp(-10000)
    return (exp(-x * x) / (x * sqrt(kPi)) - boost::math::erfc(x)) / 2;
}

glm::dvec3 cookTorrance(const Directions& d, std::span<const double> values) {
    return microfacet(d, values, [&](const Geometry& g) -> Real {
        const Real masking = std::min({Real(1), Real(2 * g.nh * g.nv / g.vh), Real(2 * g.nh * g.nl / g.vh)});
        return beckmann(g, values[6]) * masking / (4 * g.nl * g.nv);
    });
}

glm::dvec3 beckmannSmith(const Directions& d, std::span<const double> values) {
    return microfacet(d, values, [&](const Geometry& g) -> Real {
        const Real li = beckmannLambda(g.nl, values[6]), lo = beckmannLambda(g.nv, values[6]);
        const Real masking = values[7] == 0.0 ? 1 / (1 + li + lo) : 1 / ((1 + li) * (1 + lo));
        return beckmann(g, values[6]) * masking / (4 * g.nl * g.nv);
    });
}

/// D G / (4 cos cos) of GGX, height-correlated.
Real ggxLobe(const Geometry& g, double alphaX, double alphaY, double rotation) {
    const Vector h = turned(g.h, rotation);
    const Real ax = alphaX, ay = alphaY;
    const Real q = square(h.x / ax) + square(h.y / ay) + square(h.z);
    const auto lambda = [&](const Vector& w) -> Real {
        const Vector t = turned(w, rotation);
        return (sqrt(1 + (square(ax * t.x) + square(ay * t.y)) / square(t.z)) - 1) / 2;
    };
    return 1 / (kPi * ax * ay * q * q) / (1 + lambda(g.l) + lambda(g.v)) / (4 * g.nl * g.nv);
}

glm::dvec3 ggx(const Directions& d, std::span<const double> values) {
    return microfacet(d, values,
                      [&](const Geometry& g) { return ggxLobe(g, values[6], values[7], values[8]); });
}

glm::dvec3 metallicRoughness(const Directions& d, std::span<const double> values) {
    const double alpha = std::max(values[4] * values[4], 1e-4);
    return perChannel(d, [&](const Geometry& g, size_t c) -> Real {
        const Real base = values[c], metallic = values[3];
        const Real f = schlick(Real(0.04) + (base - Real(0.04)) * metallic, g.vh);
        return f * ggxLobe(g, alpha, alpha, 0.0) + (1 - f) * base * (1 - metallic) / kPi;
    });
}

/// Classic and energy-normalised form of a cosine power, whose normalisation is `energy`.
glm::dvec3 cosinePower(const Directions& d, std::span<const double> values,
                       const std::function<Real(const Geometry&)>& cosine,
                       const std::function<Real(const Real&)>& energy) {
    return perChannel(d, [&](const Geometry& g, size_t c) -> Real {
        const Real n = values[9];
        const Real base = std::max(cosine(g), Real(0));
        const Real power = n == 0 ? Real(1) : base == 0 ? Real(0) : Real(pow(base, n));
        return values[10] == 0.0 ? values[3 + c] + values[6 + c] * power / g.nl
                                 : values[3 + c] / kPi + values[6 + c] * energy(n) * power;
    });
}

glm::dvec3 phong(const Directions& d, std::span<const double> values) {
    return cosinePower(
        d, values, [](const Geometry& g) -> Real { return 2 * g.nl * g.nv - g.lv; },
        [](const Real& n) -> Real { return (n + 2) / (2 * kPi); });
}

glm::dvec3 blinnPhong(const Directions& d, std::span<const double> values) {
    return cosinePower(
        d, values, [](const Geometry& g) { return g.nh; },
        [](const Real& n) -> Real {
            return (n + 2) * (n + 4) / (8 * kPi * (exp(-n / 2 * log(Real(2))) + n));
        });
}

/// Ward 1992, equations 5a and 5b, with the angle phi_h.
Real wardLobe(const Geometry& g, std::array<double, 2> alpha, double rotation, bool halfVector, int variant) {
    const Vector h = turned(g.h, rotation);
    const Real phi = h.x == 0 && h.y == 0 ? Real(0) : Real(atan2(h.y, h.x));
    const Real widths = square(cos(phi) / alpha[0]) + square(sin(phi) / alpha[1]);
    const Real exponent =
        halfVector ? Real(2 * (1 - g.nh * g.nh) * widths / (1 + g.nh)) : Real(g.tan2H() * widths);
    const Real factor = variant == 0   ? Real(1 / sqrt(g.nl * g.nv))
                        : variant == 1 ? Real(1 / (g.nl * g.nv))
                                       : Real(1 / (square(g.vh) * pow(g.nh, 4)));
    return decay(exponent) / (4 * kPi * alpha[0] * alpha[1]) * factor;
}

glm::dvec3 ward(const Directions& d, std::span<const double> values) {
    return perChannel(d, [&](const Geometry& g, size_t c) -> Real {
        return values[c] / kPi +
               values[3 + c] * wardLobe(g, {values[6], values[6]}, 0.0, false, static_cast<int>(values[7]));
    });
}

glm::dvec3 wardAnisotropic(const Directions& d, std::span<const double> values) {
    return perChannel(d, [&](const Geometry& g, size_t c) -> Real {
        return values[c] / kPi + values[3 + c] * wardLobe(g, {values[6], values[7]}, values[8],
                                                          values[9] == 1.0, static_cast<int>(values[10]));
    });
}

glm::dvec3 ashikhminShirley(const Directions& d, std::span<const double> values) {
    return perChannel(d, [&](const Geometry& g, size_t c) -> Real {
        const Real rd = values[c], rs = values[3 + c], nu = values[6], nv = values[7];
        const Vector h = turned(g.h, values[8]);
        const Real sin2 = h.x * h.x + h.y * h.y;
        const Real exponent = sin2 == 0 ? Real(0) : Real((nu * h.x * h.x + nv * h.y * h.y) / sin2);
        const auto through = [](const Real& cosine) -> Real { return 1 - pow(1 - cosine / 2, 5); };
        const Real base = 28 * rd / (23 * kPi) * (1 - rs) * through(g.nl) * through(g.nv);
        return base + sqrt((nu + 1) * (nv + 1)) / (8 * kPi) * pow(g.nh, exponent) /
                          (g.vh * std::max(g.nl, g.nv)) * schlick(rs, g.vh);
    });
}

glm::dvec3 lafortune(const Directions& d, std::span<const double> values) {
    const std::span<const double> table = values.subspan(4);
    return perChannel(d, [&](const Geometry& g, size_t c) -> Real {
        Real f = values[c] / kPi;
        for (size_t lobe = 0; lobe < static_cast<size_t>(table[0]); ++lobe) {
            const std::span<const double> rows = table.subspan(4 + 16 * lobe + c);
            const Real s = rows[0] * g.l.x * g.v.x + rows[4] * g.l.y * g.v.y + rows[8] * g.l.z * g.v.z;
            if (s > 0) f += pow(s, Real(rows[12]));
        }
        return f;
    });
}

glm::dvec3 orenNayar(const Directions& d, std::span<const double> values) {
    return perChannel(d, [&](const Geometry& g, size_t c) -> Real {
        const Real rho = values[c], s2 = square(Real(values[3]));
        const Real thetaI = acos(g.nl), thetaR = acos(g.nv);
        const Real a = std::max(thetaI, thetaR), b = std::min(thetaI, thetaR);
        const Real planar = sqrt((square(g.l.x) + square(g.l.y)) * (square(g.v.x) + square(g.v.y)));
        const Real cosPhi = planar == 0 ? Real(1) : Real((g.l.x * g.v.x + g.l.y * g.v.y) / planar);
        const Real c1 = 1 - s2 / 2 / (s2 + Real("0.33"));
        const Real k2 = s2 / (s2 + Real("0.09"));
        if (values[4] == 1.0)
            return rho / kPi * (c1 + Real("0.45") * k2 * std::max(cosPhi, Real(0)) * sin(a) * tan(b));
        const Real x = 2 * b / kPi;
        const Real c2 = Real("0.45") * k2 * (sin(a) - (cosPhi < 0 ? Real(x * x * x) : Real(0)));
        const Real c3 = k2 / 8 * square(4 * a * b / (kPi * kPi));
        const Real direct = c1 + cosPhi * c2 * tan(b) + (1 - abs(cosPhi)) * c3 * tan((a + b) / 2);
        const Real between = Real("0.17") * rho * s2 / (s2 + Real("0.13")) * (1 - cosPhi * x * x);
        return std::max(Real(rho / kPi * (direct + between)), Real(0));
    });
}

/// The quantities of He's model that both its parts need. Lengths in units of the wavelength.
struct He {
    Real sigma0, tau;
    std::span<const double> fresnel;
    std::span<const double> wavelength;

    explicit He(std::span<const double> v)
        : sigma0(v[3]), tau(v[4]), fresnel(v.subspan(8)), wavelength(v.subspan(5, 3)) {}

    /// tau / (2 sigma0) cot(theta), for directions off the normal.
    Real argument(const Real& cosine) const {
        return tau / (2 * sigma0) * cosine / sqrt(1 - cosine * cosine);
    }
    bool flat(const Real& cosine) const {
        return sigma0 == 0 || cosine * cosine >= 1 || argument(cosine) > 100;
    }
    Real shadowing(const Real& cosine) const {
        if (flat(cosine)) return 1;
        const Real x = argument(cosine);
        const Real lambda = (exp(-x * x) / (sqrt(kPi) * x) - boost::math::erfc(x)) / 2;
        return (1 - boost::math::erfc(x) / 2) / (lambda + 1);
    }
    Real hidden(const Real& cosine) const {
        if (flat(cosine)) return 0;
        return sqrt(1 - cosine * cosine) / cosine * boost::math::erfc(argument(cosine));
    }
    /// sqrt(pi/2) z0 = sigma0 / 4 K exp(-z0^2 / (2 sigma0^2)), by bisection of x exp(x^2 / 2) = K / sqrt(8
    /// pi).
    Real effectiveSigma(const Real& k) const {
        const Real target = k / sqrt(8 * kPi);
        Real low = 0, high = 1 + target;
        if (target > 2) high = sqrt(2 * log(target)) + 1;
        for (int i = 0; i < 170; ++i) {
            const Real middle = (low + high) / 2;
            (middle * exp(middle * middle / 2) < target ? low : high) = middle;
        }
        return sigma0 / sqrt(1 + low * low);
    }
};

/// sum over m of g^m exp(-g) / (m! m) exp(-q / m), from the largest term both ways until terms are below
/// 1e-25 of it.
Real heSeries(const Real& g, const Real& q) {
    if (g == 0) return 0;
    // The largest term is where g^m / m! exp(-q / m) is: ln(g / m) + q / m^2 = 0.
    Real low = 1, high = 2 * (g + sqrt(q)) + 10;
    for (int i = 0; i < 200 && high - low > 0.5; ++i) {
        const Real middle = (low + high) / 2;
        (log(g / middle) + q / (middle * middle) > 0 ? low : high) = middle;
    }
    const auto centre = static_cast<int64_t>(low);
    const Real m0 = centre;
    const Real logPmf = m0 * log(g) - g - boost::math::lgamma(m0 + 1);
    const Real logLargest = logPmf - q / m0;
    Real sum = 0;
    for (const int direction : {1, -1}) {
        Real pmf = 1;  // over that of the centre
        for (int64_t m = centre; m >= 1; m += direction) {
            const Real here = m;
            if (direction < 0 && m == centre) {
                pmf *= here / g;
                continue;
            }
            const Real term = pmf * exp(q / m0 - q / here) / here;
            sum += term;
            if (term < Real(1e-25) / m0) break;
            pmf *= direction > 0 ? g / (here + 1) : here / g;
        }
    }
    return sum * decay(-logLargest);
}

glm::dvec3 he(const Directions& d, std::span<const double> values) {
    const He p(values);
    return perChannel(d, [&](const Geometry& g, size_t c) -> Real {
        const Real lambda = p.wavelength[c];
        const Real sigma = p.effectiveSigma(p.hidden(g.nl) + p.hidden(g.nv));
        const Real root = 2 * kPi * sigma / lambda * (g.nl + g.nv);
        const Real planar = square(g.l.x + g.v.x) + square(g.l.y + g.v.y);
        const Real q = square(kPi * p.tau / lambda) * planar;
        const Real geometry = square((2 + 2 * g.lv) / (g.nl + g.nv));
        const Real distribution = square(kPi * p.tau / lambda) / 4 * heSeries(root * root, q);
        const Real directional = fresnel(p.fresnel, c, g.vh) / kPi * geometry * p.shadowing(g.nl) *
                                 p.shadowing(g.nv) * distribution / (g.nl * g.nv);
        return values[c] / kPi + directional;
    });
}

}  // namespace

const std::map<std::string, PreciseFCos>& preciseModels() {
    static const std::map<std::string, PreciseFCos> models{
        {"phong", phong},
        {"blinn_phong", blinnPhong},
        {"cook_torrance", cookTorrance},
        {"beckmann_smith", beckmannSmith},
        {"ggx", ggx},
        {"metallic_roughness", metallicRoughness},
        {"ward", ward},
        {"ward_anisotropic", wardAnisotropic},
        {"ashikhmin_shirley", ashikhminShirley},
        {"lafortune", lafortune},
        {"oren_nayar", orenNayar},
        {"he", he},
    };
    return models;
}

glm::dvec3 preciseFresnel(std::span<const double> values, double cosTheta) {
    glm::dvec3 reflectance;
    for (size_t c = 0; c < 3; ++c)
        reflectance[static_cast<int>(c)] = static_cast<double>(fresnel(values, c, cosTheta));
    return reflectance;
}

glm::dvec3 preciseHeMirror(double cosTheta, std::span<const double> values) {
    const He p(values);
    const Real c = cosTheta;
    const Real sigma = p.effectiveSigma(2 * p.hidden(c));
    glm::dvec3 reflectance;
    for (size_t channel = 0; channel < 3; ++channel)
        reflectance[static_cast<int>(channel)] =
            static_cast<double>(fresnel(p.fresnel, channel, c) * square(p.shadowing(c)) *
                                decay(square(4 * kPi * sigma / p.wavelength[channel] * c)));
    return reflectance;
}

}  // namespace lobe::test
