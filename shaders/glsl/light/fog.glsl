/// fog.glsl - what fog takes from a ray: optical depths of straight ways, by Beer's and Lambert's law.
///
/// value  optical depth, no unit, 0 to infinity; fog_opacity and fog_transmittance of it, 0 to 1
/// params extinction   1/m, 0 to 1e6 and more
///        log_density  ln(extinction exp(-falloff (start - height))) at the ray's start; -1e30 for no extinction
///        slope        1/m: falloff times the rise of the ray a metre; negative downward
/// domain distances from 0 to infinity; never NaN. Densities below 1e-38 / m count as none, above 1e38 / m as that
/// source Beer-Lambert; the mean of an exponential over an interval
/// stable (1 - e^-x) / x by its series below 0.5, where the plain form loses the digits of 1 / x; the density of the
///        way's lower end, so that the exponential's mean is at most 1
/// error  relative: fog_phi and fog_opacity < 6.3e-7 (1.2e-7 seen); depths < 2^-24 (16 + 2 (|log_density| + |slope|
///        distance)), of which half was seen (tests/shading/fog_test.cpp)
/// twin   engine/shading/fog.cpp
#include "common/numeric.glsl"

/// (1 - e^-x) / x for x >= 0; 1 at 0, 0 at infinity.
float fog_phi(float x)
{
    // The first term left out is x^8 / 9!: 1.1e-8 at 0.5.
    float series = 1.0 - x * (1.0 / 2.0 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x * (1.0 / 120.0 - x * (1.0 / 720.0
                   - x * (1.0 / 5040.0 - x / 40320.0))))));
    return x < 0.5 ? series : (1.0 - numeric_exp(-x)) / x;
}

/// 1 - e^-depth
float fog_opacity(float depth) { return depth < 0.5 ? depth * fog_phi(depth) : 1.0 - numeric_exp(-depth); }
vec3 fog_opacity(vec3 depth) { return vec3(fog_opacity(depth.x), fog_opacity(depth.y), fog_opacity(depth.z)); }

vec3 fog_transmittance(vec3 depth) { return vec3(numeric_exp(-depth.x), numeric_exp(-depth.y), numeric_exp(-depth.z)); }

/// Of fog that is the same everywhere.
float fog_depth(float extinction, float distance) { return extinction > 0.0 ? extinction * distance : 0.0; }
vec3 fog_depth(vec3 extinction, float distance)
{
    return vec3(fog_depth(extinction.x, distance), fog_depth(extinction.y, distance), fog_depth(extinction.z, distance));
}

float fog_depth_of_density(float log_density, float effective)
{
    float density = numeric_exp(log_density);
    return density > 0.0 ? density * effective : 0.0;
}

/// Of fog whose density falls off with height.
vec3 fog_depth_by_height(vec3 log_density, float slope, float distance)
{
    float steepness = abs(slope);
    float x = steepness > 0.0 ? steepness * distance : 0.0;
    // Metres at the lower end's density that count as much as the whole way.
    float effective = x < 0.5 ? distance * fog_phi(x) : (1.0 - numeric_exp(-x)) / steepness;
    vec3 lower = log_density + (slope < 0.0 ? x : 0.0);
    return vec3(fog_depth_of_density(lower.x, effective), fog_depth_of_density(lower.y, effective),
                fog_depth_of_density(lower.z, effective));
}
