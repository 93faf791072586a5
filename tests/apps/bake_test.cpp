// What lobe bake writes, read back from its files by the formulas of its README and compared with the light
// itself.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "baked_environment.hpp"
#include "environment/environment_map.hpp"
#include "math/sphere.hpp"
#include "scene/made_environment.hpp"

namespace lobe::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
constexpr double kPi = std::numbers::pi;

/// A reader of baked folders that knows no more than the README.
class Baked {
public:
    explicit Baked(const fs::path& folder) : folder_(folder) {
        facts = json::parse(std::ifstream(folder / "environment.json"));
    }

    glm::dvec3 toMap(const glm::dvec3& d) const {
        glm::dvec3 result(0.0);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                result[i] +=
                    facts["world_from_map"][static_cast<size_t>(i)][static_cast<size_t>(j)].get<double>() *
                    d[j];
        return result;
    }

    glm::dvec3 scaled(const glm::dvec3& rgb) const {
        return rgb * glm::dvec3(facts["scale"][0].get<double>(), facts["scale"][1].get<double>(),
                                facts["scale"][2].get<double>());
    }

    glm::dvec3 octahedral(const std::string& file, const glm::dvec3& world) {
        const Image& image = picture(file);
        const glm::dvec3 d = toMap(world);
        const double n = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
        glm::dvec2 p(d.x / n, d.y / n);
        if (d.z < 0.0)
            p = {(1.0 - std::abs(p.y)) * (p.x >= 0.0 ? 1.0 : -1.0),
                 (1.0 - std::abs(p.x)) * (p.y >= 0.0 ? 1.0 : -1.0)};
        const glm::dvec2 at = (p * 0.5 + 0.5) * double(image.width) - 0.5;
        return bilinear(
            image, at,
            [&](int x, int y) {
                const int size = image.width;
                if (x < 0 || x >= size) {
                    x = std::clamp(x, 0, size - 1);
                    y = size - 1 - y;
                }
                if (y < 0 || y >= size) {
                    y = std::clamp(y, 0, size - 1);
                    x = size - 1 - x;
                }
                return std::pair(x, y);
            },
            "R");
    }

    glm::dvec3 equirectangular(const glm::dvec3& world) {
        const Image& image = picture("environment.exr");
        const glm::dvec3 d = toMap(world);
        double u = std::atan2(d.x, -d.z) / (2.0 * kPi);
        u -= std::floor(u);
        const double v = std::acos(std::clamp(d.y, -1.0, 1.0)) / kPi;
        return bilinear(
            image, {u * image.width - 0.5, v * image.height - 0.5},
            [&](int x, int y) {
                return std::pair((x % image.width + image.width) % image.width,
                                 std::clamp(y, 0, image.height - 1));
            },
            "R");
    }

    const json& model(const std::string& name) const {
        for (const json& entry : facts["models"])
            if (entry["name"] == name) return entry;
        throw std::runtime_error(name);
    }

    /// `values` and `width` are what the caller's material says.
    glm::dvec3 shown(const Brdf& brdf, std::span<const double> values, double width, const glm::dvec3& n,
                     const glm::dvec3& w) {
        const json& entry = model(brdf.name);
        const double c = glm::dot(n, w);
        const Image& split = picture(entry["split"]["file"]);
        glm::dvec2 place(std::sqrt(c) * (entry["split"]["angles"].get<int>() - 1), 0.0);
        if (!entry["width"].is_null())
            place.y = std::clamp((std::log(width) - entry["width"]["first_ln"].get<double>()) *
                                     entry["width"]["rows_per_ln"].get<double>(),
                                 0.0, entry["split"]["rows"].get<int>() - 1.0);
        const auto inside = [&](int x, int y) {
            return std::pair(std::clamp(x, 0, split.width - 1), std::clamp(y, 0, split.height - 1));
        };
        const AreaWeights weights = brdf.area->weights(values);
        glm::dvec3 sum =
            weights.lambert * bilinear(split, place, inside, "base.Y")[0] * octahedral("irradiance.exr", n);
        if (entry["layers"].empty()) return scaled(sum);
        const double across = bilinear(split, place, inside, "lobe.across")[0];
        const double along = bilinear(split, place, inside, "lobe.along")[0];
        const double layer = bilinear(split, place, inside, "lobe.layer")[0];
        glm::dvec3 side = c * n - w;
        side = glm::length(side) > 1e-9 ? glm::normalize(side) : frameAbout(n)[0];
        const glm::dvec3 d = glm::normalize(across * side + along * n);
        const auto first = static_cast<size_t>(layer);
        const size_t next = std::min(first + 1, entry["layers"].size() - 1);
        const glm::dvec3 light =
            glm::mix(octahedral(entry["layers"][first]["file"], d),
                     octahedral(entry["layers"][next]["file"], d), layer - double(first));
        sum += (weights.terms[0] * bilinear(split, place, inside, "first.R") +
                weights.terms[1] * bilinear(split, place, inside, "second.R")) *
               light;
        return scaled(sum);
    }

    json facts;

private:
    const Image& picture(const std::string& file) {
        auto found = pictures_.find(file);
        if (found == pictures_.end()) found = pictures_.emplace(file, files_.read(folder_ / file)).first;
        return found->second;
    }

    /// Three channels from a named one on; files may have them in any order.
    template<class Place>
    static glm::dvec3 bilinear(const Image& image, const glm::dvec2& at, Place place,
                               const std::string& first) {
        const std::string layer = first.size() > 1 ? first.substr(0, first.size() - 1) : "";
        std::array<size_t, 3> channels{};
        for (size_t c = 0; c < 3; ++c) {
            const std::string name = first.ends_with("R") ? layer + "RGB"[c] : first;
            const auto found = std::find(image.channels.begin(), image.channels.end(), name);
            if (found == image.channels.end()) throw std::runtime_error(name);
            channels[c] = static_cast<size_t>(found - image.channels.begin());
        }
        const int x = static_cast<int>(std::floor(at.x)), y = static_cast<int>(std::floor(at.y));
        const auto texel = [&](int i, int j) {
            const auto [px, py] = place(i, j);
            const float* pixel = image.pixel(px, py);
            return glm::dvec3(pixel[channels[0]], pixel[channels[1]], pixel[channels[2]]);
        };
        return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), at.x - x),
                        glm::mix(texel(x, y + 1), texel(x + 1, y + 1), at.x - x), at.y - y);
    }

    fs::path folder_;
    ImageFiles files_;
    std::map<std::string, Image> pictures_;
};

class Bake : public testing::Test {
protected:
    ~Bake() override { fs::remove_all(folder_); }

    void bake(const Scene& scene, const std::vector<std::string>& names,
              std::optional<std::pair<double, double>> widths = {}) {
        BakeRequest request{{}, widths};
        for (const std::string& name : names)
            request.models.push_back(&requireBrdf(name));
        ImageFiles files;
        bakeEnvironment(scene, request, folder_, files,
                        [&](const std::string& line) { lines_.push_back(line); });
    }

    fs::path folder_ = fs::path(testing::TempDir()) / ("lobe-bake-" + std::to_string(getpid()));
    std::vector<std::string> lines_;
};

Scene smooth() {
    Scene scene;
    scene.environment = Environment{};
    scene.environment->intensity = 2.0;
    Bitmap picture;
    picture.width = 128;
    picture.height = 64;
    picture.channels = 3;
    picture.type = ComponentType::f32;
    std::vector<float> values;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 128; ++x) {
            const double phi = 2.0 * kPi * (x + 0.5) / 128, theta = kPi * (y + 0.5) / 64;
            const glm::dvec3 d(std::sin(theta) * std::sin(phi), std::cos(theta),
                               -std::sin(theta) * std::cos(phi));
            for (const double light : {1.0 + 0.6 * d.y, 1.0 + 0.7 * d.x, 1.0 + 0.5 * d.z * d.x})
                values.push_back(static_cast<float>(light));
        }
    picture.data.resize(values.size() * sizeof(float));
    std::memcpy(picture.data.data(), values.data(), picture.data.size());
    scene.environment->image = addPicture(scene, std::move(picture), "smooth");
    turnEnvironment(scene, 1.0);
    return scene;
}

/// What a surface shows of it, by midpoints over the hemisphere.
glm::dvec3 truth(const EnvironmentMap& map, const Brdf& brdf, std::span<const double> values,
                 const glm::dvec3& n, const glm::dvec3& w) {
    constexpr int kRings = 256, kAround = 512;
    const glm::dmat3 frame = frameAbout(n), local = glm::transpose(frame);
    const glm::dvec3 wo = local * w;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < kRings; ++i) {
        const double polar = kPi / 2.0 * (i + 0.5) / kRings;
        for (int j = 0; j < kAround; ++j) {
            const glm::dvec3 wi = fromPolar(polar, 2.0 * kPi * (j + 0.5) / kAround);
            sum += brdf.fCos(Directions(wi, wo), values) * map.radiance(frame * wi) * std::sin(polar);
        }
    }
    return sum * (kPi / 2.0 / kRings * 2.0 * kPi / kAround);
}

TEST_F(Bake, IsReadBackByItsReadme) {
    const Scene scene = smooth();
    const EnvironmentMap map = EnvironmentMap::of(scene);
    bake(scene, {"lambert", "metallic_roughness", "oren_nayar"}, std::pair(0.2, 1.0));
    EXPECT_THAT(lines_, testing::Contains("metallic_roughness/"));
    Baked baked(folder_);
    for (const char* name : {"lambert", "metallic_roughness", "oren_nayar"}) {
        const Brdf& brdf = requireBrdf(name);
        for (const double width : {0.3, 0.5, 1.0}) {
            ParameterValues values = brdf.defaults();
            if (const int index = brdf.parameterIndex("roughness"); index >= 0)
                values[static_cast<size_t>(brdf.valueOffset(index))] = width;
            for (const glm::dvec3& n : {glm::dvec3(0, 1, 0), glm::normalize(glm::dvec3(1, 0.2, -0.5))})
                for (const double angle : {0.0, 0.5, 1.1}) {
                    const glm::dvec3 w = glm::dmat3(frameAbout(n)) * fromPolar(angle, 2.0);
                    const glm::dvec3 expected = truth(map, brdf, values, n, w);
                    const glm::dvec3 found = baked.shown(brdf, values, width, n, w);
                    // The split sum's own error, which docs/environment.md has at 7 % for grazing angles.
                    const double tolerance = angle < 1.0 ? 0.02 : 0.07;
                    for (int c = 0; c < 3; ++c)
                        EXPECT_NEAR(found[c], expected[c], tolerance * expected[c])
                            << name << ' ' << width << ' ' << angle << ' ' << c;
                }
        }
    }
    for (const glm::dvec3& d : {glm::dvec3(0.6, 0.64, 0.48), glm::dvec3(-0.48, -0.6, 0.64)})
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(baked.scaled(baked.equirectangular(d))[c], map.radiance(d)[c], 1e-5);
}

TEST_F(Bake, WidthsAreThoseAskedForWithinTheModels) {
    bake(smooth(), {"metallic_roughness", "ggx"}, std::pair(1e-6, 0.5));
    const Baked baked(folder_);
    const json& width = baked.model("metallic_roughness")["width"];
    EXPECT_EQ(width["from"], requireBrdf("metallic_roughness").area->widths.first);
    EXPECT_EQ(width["to"], 0.5);
    EXPECT_EQ(width["parameter"], "roughness");
    EXPECT_TRUE(baked.model("ggx")["width"].is_null());
}

TEST_F(Bake, ASunIsNamedAndFilesOfOthersStay) {
    Scene scene;
    scene.environment = Environment{};
    scene.environment->source.sky = Sky{};
    makeEnvironment(scene);
    fs::create_directories(folder_);
    std::ofstream(folder_ / "mine.txt") << "mine";
    std::ofstream(folder_ / "environment.json") << "old";
    bake(scene, {"lambert"});
    const Baked baked(folder_);
    EXPECT_TRUE(fs::exists(folder_ / "mine.txt"));
    const json& sun = baked.facts["sun"];
    EXPECT_NEAR(sun["direction"][1].get<double>(), std::sin(Sky{}.sunElevation), 1e-9);
    EXPECT_NEAR(sun["diameter"].get<double>(), kSunDiameter, 1e-9);
    const Light& light = scene.lights.at(0);
    const double solidAngle = kPi * std::pow(std::sin(kSunDiameter / 2.0), 2.0);
    EXPECT_NEAR(sun["irradiance"][1].get<double>(), light.intensity.g * solidAngle,
                1e-6 * light.intensity.g * solidAngle);
    EXPECT_TRUE(fs::exists(folder_ / "README.md"));
}

TEST(BakedModels, WhyNot) {
    EXPECT_EQ(whyNotBaked(requireBrdf("ggx")), "");
    EXPECT_THAT(whyNotBaked(requireBrdf("mirror")), testing::HasSubstr("mirrors"));
    EXPECT_THAT(whyNotBaked(requireBrdf("he")), testing::HasSubstr("not split"));
}

}  // namespace
}  // namespace lobe::app
