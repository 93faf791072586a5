/// An environment as one model shows it: the map blurred by the model's own lobe at several widths, what a
/// table says of each angle of view, and irradiance, all in one picture that GLSL reads
/// (pass/environment.glsl).
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/number_store.hpp"
#include "environment/environment_map.hpp"
#include "environment/radiance_tree.hpp"
#include "fit/area_table.hpp"

namespace lobe::environment {

/// Changes whenever the same input would give other texels: part of the key under which they are kept.
inline constexpr int kVersion = 4;

/// What is made.
struct Request {
    fit::TableRequest lobe;
    std::pair<double, double> widths{0.0, 0.0};  ///< of AreaModel::width, where it varies
    bool irradiance = true;                      ///< a square of it; else harmonics stand for it
};

/// An octahedral map of `size` squares a side with a border of one, at x, y of the picture.
struct Square {
    int x = 0, y = 0, size = 0;
};

/// At most so many layers, each about sqrt(2) times as wide as the last.
inline constexpr size_t kMostLayers = 16;

struct Prefiltered {
    int width = 0, height = 0;
    std::vector<float> texels;   ///< RGBA, rows from y = 0 on
    std::vector<Square> layers;  ///< from narrow to wide
    Square irradiance;           ///< of irradiance / pi; size 0: none
    int tableX = 0, tableY = 0;  ///< kAngles x tableRows texels three times, side by side
    int tableRows = 1;
    double firstLogWidth = 0.0;  ///< of the table's rows: ln of the first width
    double rowsPerLogWidth = 0.0;
};

Prefiltered prefiltered(const RadianceTree& tree, const Request& request);

/// A hash of the map, the request and the version.
std::string keyOf(const EnvironmentMap& map, const Request& request);

/// Those that were made, kept between runs (base/number_store.hpp).
class Cache {
public:
    /// In $XDG_CACHE_HOME/lobe/environment, else ~/.cache/lobe/environment; without a home nothing is kept.
    Cache();
    explicit Cache(std::filesystem::path folder) : store_(std::move(folder), ".env", kVersion) {}
    std::optional<Prefiltered> find(const std::string& key) const;
    /// Failing to keep it is no error: it is made again.
    void keep(const std::string& key, const Prefiltered& made) const;

private:
    NumberStore store_;
};

}  // namespace lobe::environment
