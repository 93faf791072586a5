/// Measured complex indices of metals over visible light.
#pragma once

#include <complex>
#include <string>
#include <string_view>
#include <vector>

namespace lobe::shading {

/// The index eta + i k of one metal in air, for wavelengths of at least 380 to 780 nm.
struct MetalSpectrum {
    struct Sample {
        double wavelength;  ///< nm, ascending
        double eta, k;
    };
    std::string name;  ///< as in metals()
    std::vector<Sample> samples;

    /// Linear between the samples; the end's beyond them.
    std::complex<double> index(double wavelength) const;
};

/// Of those of metals() whose spectra were at hand: Palik, Handbook of Optical Constants of Solids, 1985, and
/// others, as published with pbrt (chromium, nickel, tungsten and titanium nitride there by way of the
/// database luxpop.com), sample by sample.
const std::vector<MetalSpectrum>& metalSpectra();

/// Null for a name that is not among them.
const MetalSpectrum* metalSpectrum(std::string_view name);

}  // namespace lobe::shading
