/// Materials at points of triangles: the engine's reading of surfaces, in double from the scene format's
/// rules.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "reference/mesh.hpp"
#include "reference/texture_reader.hpp"

namespace lobe::reference {

class SurfaceReader {
public:
    /// Keeps a reference to the scene. Decodes what textures its instances use.
    explicit SurfaceReader(const Scene& scene);

    AlphaMode alphaMode(const Mesh& mesh) const { return materialOf(mesh).alphaMode; }
    /// Whether the ray goes on behind it: blended, or of a model that lets light through.
    bool seenThrough(const Mesh& mesh) const { return readingOf(mesh).seenThrough; }
    /// Whether back faces are left out.
    bool oneSided(const Mesh& mesh) const { return !materialOf(mesh).doubleSided; }
    /// Whether every point of it blocks light whole.
    bool opaque(const Mesh& mesh) const { return alphaMode(mesh) == AlphaMode::opaque; }

    /// Coverage: 1 of opaque materials, 0 or 1 of masked ones, 0..1 of blended ones.
    double coverage(const Mesh& mesh, const Hit& hit, const Footprint& footprint) const;

    /// All but the position and the distances, which the ray gives.
    SurfacePoint read(const Mesh& mesh, const Hit& hit, const Footprint& footprint) const;

private:
    struct Place;
    struct Slot {
        const TextureSlot* slot = nullptr;
        const TextureReader* reader = nullptr;  ///< null: a texture without an image, white
    };
    /// What of a material is read from textures.
    struct Reading {
        bool used = false;
        bool seenThrough = false;
        const Brdf* brdf = nullptr;
        std::vector<Slot> parameters;  ///< as Brdf::parameters
        Slot alpha, normal, occlusion, emission;
    };

    const Material& materialOf(const Mesh& mesh) const;
    const Reading& readingOf(const Mesh& mesh) const;
    Reading prepare(const Material& material);
    Slot prepare(const TextureSlot& slot, bool srgb);
    glm::dvec4 sample(const Slot& slot, const Place& place) const;
    void readFrame(const Reading& reading, const Material& material, const Place& place, bool front,
                   SurfacePoint& point) const;
    void readParameters(const Reading& reading, const Material& material, const Place& place,
                        SurfacePoint& point) const;

    const Scene& scene_;
    bool ambient_;
    std::map<std::pair<int, bool>, std::unique_ptr<TextureReader>> textures_;  ///< by image, sRGB
    std::vector<Reading> readings_;                                            ///< by material
};

}  // namespace lobe::reference
