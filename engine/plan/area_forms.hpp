/// In which form each model of a scene shows lights with a body: by one table of fits for all its materials,
/// or not.
#pragma once

#include <map>
#include <string>

#include "fit/area_table.hpp"
#include "scene/scene.hpp"

namespace lobe {

struct AreaForm {
    fit::TableRequest request = {};  ///< what the materials have in common, and what varies among them
    std::string refusal;             ///< why there is none: "its lobe has two widths"; else empty
    int terms = 0;                   ///< fits of each node: 0 for Lambert's part alone
    /// Of AreaModel::width, what the materials use, textures included; without a width both 0.
    std::pair<double, double> widths{0.0, 0.0};
    int firstRow = 0;  ///< in the buffer of tables, after those of the models
};

/// Of the models of materials that are in use, by name; those of FramePlan's unlit surfaces have none.
std::map<std::string, AreaForm> areaForms(const Scene& scene);

}  // namespace lobe
