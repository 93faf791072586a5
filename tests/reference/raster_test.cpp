// Traced surfaces against the engine's pictures of the same scenes: where the two may differ, and by how much
// (docs/reference.md, "Surfaces").
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "passes/renderer.hpp"
#include "reference/tracer.hpp"
#include "scene/load.hpp"

namespace lobe::reference {
namespace {

constexpr int kWidth = 160, kHeight = 120;
/// Steps that rasterisers round vertices to: GL asks for 4 bits of subpixels, all drivers have 8.
constexpr double kSubpixel = 1.0 / 256.0;
constexpr double kFloat = 0x1p-24;

constexpr int kFootprints = 7;
constexpr double kUnknown = -1.0;

using Layers = std::vector<SurfacePoint>;

/// What a picture holds of a pixel, in the order of its channels.
struct Seen {
    int material = 0;
    std::pair<uint32_t, uint32_t> triangle;  ///< with its instance
    std::vector<double> values;
};
struct Quantity {
    const char* channel;
    int first, count;
};
constexpr std::array kQuantities{Quantity{"depth.Z", 0, 1}, Quantity{"position.X", 1, 3},
                                 Quantity{"normal.X", 4, 3}, Quantity{"albedo.R", 7, 3},
                                 Quantity{"roughness.Y", 10, 1}};

class Reference {
public:
    Reference(const std::shared_ptr<const Scene>& scene, const View& view)
        : view_(view), scene_(scene), tracer_(scene, view.eye) {}

    /// The first surface that writes depth at a point of the picture; textures at `footprint` times the
    /// pixel's.
    Seen at(double x, double y, double footprint = 1.0) const {
        RayDifferentials change = pixelDifferentials(view_);
        for (glm::dvec3* d : {&change.originDx, &change.originDy, &change.directionDx, &change.directionDy})
            *d *= footprint;
        Layers layers;
        tracer_.surfacesAlong(pixelRay(view_, x, y), &change, layers);
        Seen seen;
        seen.values.assign(11, 0.0);
        if (layers.empty() || layers.back().alphaMode == AlphaMode::blend) return seen;
        const SurfacePoint& point = layers.back();
        seen.material = point.material + 1;
        seen.triangle = {point.instance, point.triangle};
        const auto put = [&seen](size_t first, const glm::dvec3& v) {
            for (int c = 0; c < 3; ++c)
                seen.values[first + static_cast<size_t>(c)] = v[c];
        };
        seen.values[0] = point.t;
        put(1, point.position);
        put(4, point.normal);
        seen.values[10] = 1.0;
        if (point.brdf == nullptr) return seen;
        put(7, point.brdf->ambient(point.values()));
        // Other models' equivalents of it have no twin.
        const int roughness = point.brdf->parameterIndex("roughness");
        seen.values[10] = roughness < 0
                              ? kUnknown
                              : point.values()[static_cast<size_t>(point.brdf->valueOffset(roughness))];
        return seen;
    }

    bool textured() const { return !scene_->images.empty(); }

private:
    View view_;
    std::shared_ptr<const Scene> scene_;
    Tracer tracer_;
};

/// Places that one pixel's centre may stand for once vertices are rounded, and that one itself.
std::vector<glm::dvec2> placesAbout(double x, double y) {
    std::vector<glm::dvec2> places{{x, y}};
    for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j)
            if (i != 0 || j != 0) places.emplace_back(x + i * kSubpixel, y + j * kSubpixel);
    return places;
}

size_t channelOf(const Image& image, const std::string& name) {
    return static_cast<size_t>(std::find(image.channels.begin(), image.channels.end(), name) -
                               image.channels.begin());
}

struct Counts {
    int compared = 0, edges = 0, wrong = 0;
    double largestShare = 0.0;  ///< of its bound that a difference reaches
    std::string worst;
};

/// The engine's value is inside the range of what the reference sees at the places and footprints that GL
/// leaves open, within what floats and 16-bit codes round.
Counts compare(const Reference& reference, const Image& image) {
    Counts counts;
    const size_t id = channelOf(image, "material.id");
    for (int row = 0; row < kHeight; ++row)
        for (int x = 0; x < kWidth; ++x) {
            const float* pixel = image.pixel(x, row);
            const int drawn = static_cast<int>(pixel[id]);
            const auto places = placesAbout(x + 0.5, kHeight - row - 0.5);
            std::vector<Seen> same;
            for (const glm::dvec2& place : places) {
                const Seen seen = reference.at(place.x, place.y);
                if (seen.material == drawn) same.push_back(seen);
            }
            if (same.size() < places.size()) ++counts.edges;
            if (same.empty()) {
                ++counts.wrong;
                counts.worst = "material at " + std::to_string(x) + ", " + std::to_string(row);
                continue;
            }
            if (same.size() < places.size() || drawn == 0) continue;
            const bool oneTriangle = std::all_of(same.begin(), same.end(), [&](const Seen& seen) {
                return seen.triangle == same[0].triangle;
            });
            // GL lets a footprint be from 1/sqrt(2) to 2 times the ideal one.
            std::vector<Seen> scaled;
            for (int step = 0; reference.textured() && step < kFootprints; ++step)
                for (const glm::dvec2& place : places)
                    scaled.push_back(reference.at(place.x, place.y, std::exp2(0.25 * step - 0.5)));
            ++counts.compared;
            for (const Quantity& quantity : kQuantities) {
                const float* value = pixel + channelOf(image, quantity.channel);
                const bool isPlace = quantity.first < 4;
                for (int c = 0; c < quantity.count; ++c) {
                    const size_t i = static_cast<size_t>(quantity.first) + static_cast<size_t>(c);
                    double low = same[0].values[i], high = low;
                    if (low == kUnknown && i == 10) continue;
                    const auto include = [&, i](const std::vector<Seen>& all) {
                        for (const Seen& seen : all) {
                            low = std::min(low, seen.values[i]);
                            high = std::max(high, seen.values[i]);
                        }
                    };
                    include(same);
                    include(scaled);
                    // Between two footprints values change linearly but for one bend, where a level is
                    // reached: beyond both by no more than they change from one footprint to the next.
                    double bend = 0.0;
                    for (size_t n = places.size(); n < scaled.size(); ++n)
                        bend = std::max(bend,
                                        std::abs(scaled[n].values[i] - scaled[n - places.size()].values[i]));
                    // Places: a chain of a dozen float operations on numbers up to the distance, and the
                    // world coordinate's own rounding. Others: 32-bit G-buffer and texels.
                    const double rounding =
                        isPlace ? kFloat * (32.0 * same[0].values[0] + std::abs(low)) : 64.0 * kFloat;
                    const double off = std::max(
                        {low - static_cast<double>(value[c]), static_cast<double>(value[c]) - high, 0.0});
                    // Where a triangle ends this near, the rasteriser may draw it further than it reaches:
                    // its values go on past those of its neighbour by as much as they change here.
                    const double bound = rounding + bend + (oneTriangle ? 0.0 : high - low);
                    if (off / bound <= counts.largestShare) continue;
                    counts.largestShare = off / bound;
                    counts.worst = std::string(quantity.channel) + "+" + std::to_string(c) + " at " +
                                   std::to_string(x) + ", " + std::to_string(row) + ": " +
                                   std::to_string(value[c]) + ", reference " + std::to_string(low) + " to " +
                                   std::to_string(high);
                }
            }
        }
    return counts;
}

gl::Context& context() {
    static const std::unique_ptr<gl::Context> one = gl::Context::create({.backend = gl::Backend::egl});
    return *one;
}

struct Shot {
    std::shared_ptr<const Scene> scene;
    View view{};
    Image image;
};

Shot drawn(const std::string& file) {
    Shot shot;
    SceneLoader loader;
    shot.scene = std::make_shared<const Scene>(loader.load(std::string(LOBE_SOURCE_DIR) + "/scenes/" + file));
    const Camera camera = shot.scene->cameras.empty()
                              ? framingCamera(shot.scene->bounds(), double{kWidth} / kHeight)
                              : shot.scene->cameras[0];
    RenderOptions options;
    options.width = kWidth;
    options.height = kHeight;
    options.quality = qualityPreset("converged");
    options.quality.samples = 1;
    options.aovs = {Aov::depth, Aov::position, Aov::normal, Aov::albedo, Aov::materialId, Aov::roughness};
    context().makeCurrent();
    Renderer renderer(context());
    renderer.setScene(shot.scene, options);
    shot.image = renderer.render(camera).image;
    shot.view = makeView(camera, kWidth, kHeight);
    return shot;
}

class RasterScene : public testing::TestWithParam<const char*> {};

TEST_P(RasterScene, SurfacesAreTheEnginesOwn) {
    const Shot shot = drawn(GetParam());
    const Counts counts = compare(Reference(shot.scene, shot.view), shot.image);
    RecordProperty("edges", counts.edges);
    RecordProperty("share", std::to_string(counts.largestShare) + " " + counts.worst);
    EXPECT_EQ(counts.wrong, 0) << counts.worst;
    EXPECT_LE(counts.largestShare, 1.0) << counts.worst;
    EXPECT_LT(counts.edges, kWidth * kHeight / 100);
    EXPECT_GT(counts.compared, 1000);
}

/// The comparison finds each of these.
TEST(Raster, FaultsAreFound) {
    const Shot shot = drawn("textured.gltf");
    const auto found = [&](const std::function<void(Scene&)>& plant) {
        auto scene = std::make_shared<Scene>(*shot.scene);
        plant(*scene);
        const Counts counts = compare(Reference(scene, shot.view), shot.image);
        return counts.wrong > 0 || counts.largestShare > 1.0;
    };
    const auto foundInMaterials = [&](const std::function<void(Material&)>& plant) {
        return found(
            [&](Scene& scene) { std::for_each(scene.materials.begin(), scene.materials.end(), plant); });
    };
    const auto foundInSlots = [&](const std::function<void(TextureSlot&)>& plant) {
        return foundInMaterials(
            [&](Material& m) { std::for_each(m.textures.begin(), m.textures.end(), plant); });
    };
    EXPECT_FALSE(found([](Scene&) {}));
    EXPECT_TRUE(foundInMaterials([](Material& m) { m.normalScale *= 1.05f; }));
    EXPECT_TRUE(foundInMaterials([](Material& m) { m.alphaCutoff += 0.3f; }));
    EXPECT_TRUE(foundInSlots([](TextureSlot& slot) { slot.rotation += 0.05f; }));
    EXPECT_TRUE(foundInSlots([](TextureSlot& slot) { slot.uvSet = 0; }));
    EXPECT_TRUE(found([](Scene& scene) {
        for (Texture& texture : scene.textures)
            texture.sampler.wrapS = texture.sampler.wrapT = Wrap::repeat;
    }));
    EXPECT_TRUE(found([](Scene& scene) {
        for (Primitive& primitive : scene.primitives)
            for (glm::vec4& color : primitive.colors)
                color.g *= 0.99f;
    }));
    EXPECT_TRUE(found([](Scene& scene) {
        for (Instance& instance : scene.instances)
            instance.worldFromLocal[3].z += 1e-4;
    }));
}

INSTANTIATE_TEST_SUITE_P(Scenes, RasterScene,
                         testing::Values("spheres.gltf", "models.gltf", "textured.gltf", "teapot.gltf",
                                         "lights.gltf", "vases.gltf", "blend.gltf", "white_plane.gltf",
                                         "extreme/far_from_origin.gltf", "extreme/scale_tiny.gltf",
                                         "extreme/scale_huge.gltf"));

}  // namespace
}  // namespace lobe::reference
