/// Fog between surface and eye (LOBE_fog).
#pragma once

#include "scene/scene.hpp"

namespace lobe::reference {

/// Transmittance exp(-optical depth) of a straight way of `length` metres (or infinity) that starts at world
/// height `start` and rises by `rise` (-1 to 1) a metre. The exponential's mean is taken from the lower end,
/// so that it does not overflow, and by expm1, so that nothing cancels.
glm::dvec3 fogTransmittance(const Fog& fog, double start, double rise, double length);

}  // namespace lobe::reference
