#include "baked_environment.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "baked_readme.hpp"
#include "base/atomic_file.hpp"
#include "environment/harmonics.hpp"
#include "environment/prefiltered.hpp"
#include "environment/split_table.hpp"
#include "lobe_paths.hpp"

namespace lobe::app {
namespace {

namespace fs = std::filesystem;
using environment::Prefiltered;
using environment::Square;
using nlohmann::ordered_json;

ordered_json arrayOf(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

void write(ImageFiles& files, const fs::path& file, const Image& image) {
    files.write(file, image,
                {.metadata = {{"Software", std::string("lobe ") + paths::kVersion}},
                 .exrPrecision = ExrPrecision::single});
}

/// The picture itself, without its scale, in the map's axes.
Image mapImage(const EnvironmentMap& map) {
    Image image(map.width(), map.height(), {"R", "G", "B"});
    for (int y = 0; y < map.height(); ++y)
        for (int x = 0; x < map.width(); ++x)
            for (int c = 0; c < 3; ++c)
                image.pixel(x, y)[c] = static_cast<float>(map.at(x, y)[c]);
    return image;
}

const float* texelOf(const Prefiltered& made, int x, int y) {
    return &made.texels[4 *
                        (static_cast<size_t>(y) * static_cast<size_t>(made.width) + static_cast<size_t>(x))];
}

/// A square without its border.
Image squareImage(const Prefiltered& made, const Square& square) {
    Image image(square.size, square.size, {"R", "G", "B"});
    for (int y = 0; y < square.size; ++y)
        for (int x = 0; x < square.size; ++x)
            std::copy_n(texelOf(made, square.x + 1 + x, square.y + 1 + y), 3, image.pixel(x, y));
    return image;
}

Image tableImage(const Prefiltered& made) {
    Image image(environment::kAngles, made.tableRows,
                {"first.R", "first.G", "first.B", "second.R", "second.G", "second.B", "base.Y", "lobe.across",
                 "lobe.along", "lobe.layer"});
    for (int y = 0; y < made.tableRows; ++y)
        for (int x = 0; x < environment::kAngles; ++x) {
            float* pixel = image.pixel(x, y);
            const auto block = [&](int i) {
                return texelOf(made, made.tableX + x + i * environment::kAngles, made.tableY + y);
            };
            std::copy_n(block(0), 3, pixel);
            std::copy_n(block(1), 3, pixel + 3);
            pixel[6] = block(0)[3];
            std::copy_n(block(2), 3, pixel + 7);
        }
    return image;
}

environment::Request requestOf(const Brdf& brdf, const BakeRequest& bake, bool irradiance) {
    environment::Request request{{&brdf, brdf.defaults()}, {0.0, 0.0}, irradiance};
    request.lobe.colorsVary = true;
    const AreaModel& area = *brdf.area;
    if (area.width.empty()) return request;
    const auto [least, most] = area.widths;
    const auto [from, to] = bake.widths.value_or(area.widths);
    request.lobe.widthVaries = true;
    request.widths = {std::clamp(from, least, most), std::clamp(to, least, most)};
    return request;
}

ordered_json sunOf(const Scene& scene) {
    const int index = scene.environment->sun;
    if (index < 0) return nullptr;
    const Light& sun = scene.lights[static_cast<size_t>(index)];
    const bool disk = sun.type == LightType::disk;
    const double radius =
        disk ? std::atan(sun.radius / glm::length(sun.position - scene.bounds().center())) : 0.0;
    const double sine = std::sin(radius);
    return {{"direction", arrayOf(-sun.direction)},
            {"irradiance", arrayOf(sun.intensity * (disk ? std::numbers::pi * sine * sine : 1.0))},
            {"diameter", 2.0 * radius}};
}

ordered_json harmonicsOf(const environment::RadianceTree& tree, int order) {
    ordered_json list = ordered_json::array();
    for (const glm::vec3& rgb : environment::irradianceHarmonics(tree, order))
        list.push_back(arrayOf(glm::dvec3(rgb)));
    return list;
}

class Bake {
public:
    Bake(const Scene& scene, const BakeRequest& request, fs::path folder, ImageFiles& files)
        : request_(request),
          folder_(std::move(folder)),
          files_(files),
          map_(EnvironmentMap::of(scene)),
          tree_(map_) {
        const glm::dmat3 worldFromMap = glm::transpose(map_.mapFromWorld());
        facts_ = {{"schema", 1},
                  {"made_by", std::string("lobe ") + paths::kVersion},
                  {"scale", arrayOf(map_.scale())},
                  {"world_from_map",
                   {arrayOf(worldFromMap[0]), arrayOf(worldFromMap[1]), arrayOf(worldFromMap[2])}},
                  {"sun", sunOf(scene)},
                  {"notes", scene.environment->notes}};
        facts_["environment"] = {
            {"file", "environment.exr"}, {"width", map_.width()}, {"height", map_.height()}};
    }

    void run(const std::function<void(const std::string&)>& done) {
        write(files_, folder_ / "environment.exr", mapImage(map_));
        done("environment.exr");
        const Prefiltered lambert = made(requestOf(requireBrdf("lambert"), request_, true));
        write(files_, folder_ / "irradiance.exr", squareImage(lambert, lambert.irradiance));
        facts_["irradiance"] = {{"file", "irradiance.exr"},
                                {"size", lambert.irradiance.size},
                                {"harmonics_order_2", harmonicsOf(tree_, 2)},
                                {"harmonics_order_4", harmonicsOf(tree_, 4)}};
        done("irradiance.exr");
        facts_["models"] = ordered_json::array();
        for (const Brdf* brdf : request_.models) {
            facts_["models"].push_back(model(*brdf));
            done(brdf->name + "/");
        }
        writeAtomically(folder_ / "README.md", bakedReadme());
        writeAtomically(folder_ / "environment.json", facts_.dump(1) + "\n");  // last: what it names is there
        done("environment.json, README.md");
    }

private:
    /// As the renderer keeps them.
    Prefiltered made(const environment::Request& request) {
        const std::string key = keyOf(map_, request);
        std::optional<Prefiltered> found = cache_.find(key);
        if (!found) {
            found = prefiltered(tree_, request);
            cache_.keep(key, *found);
        }
        return std::move(*found);
    }

    ordered_json model(const Brdf& brdf) {
        const environment::Request request = requestOf(brdf, request_, false);
        const Prefiltered result = made(request);
        ordered_json facts = {{"name", brdf.name}, {"terms", brdf.area->terms}, {"width", nullptr}};
        if (request.lobe.widthVaries)
            facts["width"] = {{"parameter", brdf.area->width},    {"from", request.widths.first},
                              {"to", request.widths.second},      {"rows", result.tableRows},
                              {"first_ln", result.firstLogWidth}, {"rows_per_ln", result.rowsPerLogWidth}};
        facts["layers"] = ordered_json::array();
        for (size_t i = 0; i < result.layers.size(); ++i) {
            const std::string file = brdf.name + "/layer_" + (i < 10 ? "0" : "") + std::to_string(i) + ".exr";
            write(files_, folder_ / file, squareImage(result, result.layers[i]));
            facts["layers"].push_back({{"file", file}, {"size", result.layers[i].size}});
        }
        facts["split"] = {
            {"file", brdf.name + "/split.exr"}, {"angles", environment::kAngles}, {"rows", result.tableRows}};
        write(files_, folder_ / brdf.name / "split.exr", tableImage(result));
        return facts;
    }

    const BakeRequest& request_;
    fs::path folder_;
    ImageFiles& files_;
    EnvironmentMap map_;
    environment::RadianceTree tree_;
    environment::Cache cache_;
    ordered_json facts_;
};

}  // namespace

std::string whyNotBaked(const Brdf& brdf) {
    if (!brdf.traits.scattersLight) return "it mirrors: environment.exr is what it shows";
    if (!brdf.area) return "its lobe is not split from the environment";
    return fit::refusal({&brdf, brdf.defaults()}).value_or("");
}

void bakeEnvironment(const Scene& scene, const BakeRequest& request, const fs::path& folder,
                     ImageFiles& files, const std::function<void(const std::string&)>& done) {
    Bake(scene, request, folder, files).run(done);
}

}  // namespace lobe::app
