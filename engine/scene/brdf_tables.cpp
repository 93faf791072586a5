#include "scene/brdf_tables.hpp"

#include <algorithm>

#include "shading/bands.hpp"

namespace lobe {
namespace {

/// The material's table and the value that holds its place; empty for models without.
struct Table {
    std::span<const double> rows;
    size_t place = 0;  ///< index into Material::values
};

Table tableOf(const Material& material) {
    const Brdf* brdf = findBrdf(material.brdf);
    if (brdf == nullptr) return {};
    if (shading::hasBands(*brdf, material.values)) {
        const shading::FresnelPlaces places = *shading::fresnelPlaces(*brdf);
        return {shading::bandRowsIn(std::span(material.values).subspan(places.eta, 3)), places.k};
    }
    if (!brdf->table) return {};
    return {brdf->tableOf(material.values), static_cast<size_t>(brdf->valueOffset(brdf->tableParameter()))};
}

}  // namespace

void placeTables(std::vector<Material>& materials) {
    std::vector<std::pair<std::span<const double>, double>> placed;
    double next = 0.0;
    for (Material& material : materials) {
        const Table table = tableOf(material);
        if (table.rows.empty()) continue;
        const auto known = std::find_if(placed.begin(), placed.end(), [&](const auto& other) {
            return std::equal(other.first.begin(), other.first.end(), table.rows.begin(), table.rows.end());
        });
        material.values[table.place] = known != placed.end() ? known->second : next;
        if (known != placed.end()) continue;
        placed.emplace_back(table.rows, next);
        const size_t rows = table.rows.size() / 4;
        next += static_cast<double>(rows);
    }
}

size_t tableRows(const std::vector<Material>& materials) {
    size_t rows = 0;
    for (const Material& material : materials) {
        const Table table = tableOf(material);
        if (!table.rows.empty())
            rows = std::max(rows, static_cast<size_t>(material.values[table.place]) + table.rows.size() / 4);
    }
    return rows;
}

std::vector<float> gatherTables(const std::vector<Material>& materials) {
    std::vector<float> all(4 * tableRows(materials));
    for (const Material& material : materials) {
        const Table table = tableOf(material);
        if (!table.rows.empty())
            std::transform(table.rows.begin(), table.rows.end(),
                           all.begin() + 4 * static_cast<std::ptrdiff_t>(material.values[table.place]),
                           [](double number) { return static_cast<float>(number); });
    }
    return all;
}

}  // namespace lobe
