#include "image/tone.hpp"

#include "image/tone_curves.hpp"
#include "image/tone_loops.hpp"

namespace lobe {

const std::vector<std::string>& toneMappingNames() {
    static const std::vector<std::string> names = {"none", "reinhard", "aces", "agx", "neutral"};
    return names;
}

void toneMap(ToneMapping curve, float rgb[3]) {
    toneMapPlanes(curve, {&rgb[0], &rgb[1], &rgb[2]}, 1);
}

namespace {

void clampPlane(float* plane, size_t count) {
    for (size_t i = 0; i < count; ++i)
        plane[i] = curves::clamp01(plane[i]);
}

}  // namespace

void toneMapPlanes(ToneMapping curve, const Planes& planes, size_t count) {
    using namespace curves;
    const auto loop = [&](auto&& map) {
        for (size_t i = 0; i < count; ++i) {
            Rgb c{larger(planes.r[i], 0.0F), larger(planes.g[i], 0.0F), larger(planes.b[i], 0.0F)};
            // Beyond kBrightest the hue is kept, so that sums and squares stay finite.
            const float scale = kBrightest / larger(kBrightest, larger(c.r, larger(c.g, c.b)));
            c = map(Rgb{c.r * scale, c.g * scale, c.b * scale});
            planes.r[i] = clamp01(c.r);
            planes.g[i] = clamp01(c.g);
            planes.b[i] = clamp01(c.b);
        }
    };
    switch (curve) {
        case ToneMapping::none:
            for (float* const plane : {planes.r, planes.g, planes.b})
                clampPlane(plane, count);
            return;
        case ToneMapping::reinhard:
            return loop([](Rgb c) { return reinhard(c); });
        case ToneMapping::aces:
            return loop([](Rgb c) { return aces(c); });
        case ToneMapping::agx:
            return loop([](Rgb c) { return agx(c); });
        case ToneMapping::neutral:
            return loop([](Rgb c) { return neutral(c); });
    }
}

}  // namespace lobe
