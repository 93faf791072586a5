#include "environment/prefiltered.hpp"

#include <algorithm>
#include <cmath>

#include "environment/split_table.hpp"
#include "fit/table_cache.hpp"

namespace lobe::environment {
namespace {

constexpr int kIrradianceSize = 64;
constexpr int kTableWidths = 17;
constexpr int kLeastLayer = 24;
/// Larger layers are read in rings, smaller ones are sums over the whole sphere.
constexpr int kLargestSummed = 100;
/// Of layers that are blurred at all.
constexpr int kMostBlurred = 512;
/// Squares along a side of a layer times its lobe's spread: about a third of it is one square.
constexpr double kSquaresPerSpread = 7.0;
/// Of each layer's lobe over the last one's; below this spread, where little is seen of the difference, 1.4
/// times that.
constexpr double kStep = 1.45, kFineSpread = 0.02;

/// A lobe that the map is blurred with.
struct Layer {
    ZonalKernel kernel;
    double spread;
};

ParameterValues valuesAt(const Request& request, double width) {
    ParameterValues values = fit::normalised(request.lobe).values;
    const Brdf& brdf = *request.lobe.brdf;
    if (request.lobe.widthVaries)
        values[static_cast<size_t>(brdf.valueOffset(brdf.parameterIndex(brdf.area->width)))] = width;
    return values;
}

/// The place of a spread among ascending ones, as its logarithm lies.
double placeAmong(const std::vector<Layer>& layers, double spread) {
    size_t i = 0;
    while (i + 2 < layers.size() && layers[i + 1].spread < spread)
        ++i;
    if (layers.size() < 2) return 0.0;
    const double low = std::log(layers[i].spread), high = std::log(layers[i + 1].spread);
    const double t = high > low ? (std::log(std::max(spread, 1e-9)) - low) / (high - low) : 0.0;
    return static_cast<double>(i) + std::clamp(t, 0.0, 1.0);
}

struct Row {
    double width;
    std::vector<SplitNode> nodes;
};

/// From narrow to wide: at steps of spread among the rows, which are the widths in use, and before them what
/// the narrowest lobe becomes at grazing angles.
std::vector<Layer> layersFor(const Request& request, const std::vector<Row>& rows, double finest) {
    const Brdf& brdf = *request.lobe.brdf;
    const auto spreadOf = [](const Row& row) { return row.nodes.back().spread; };
    std::vector<const Row*> sorted;
    for (const Row& row : rows)
        sorted.push_back(&row);
    std::sort(sorted.begin(), sorted.end(),
              [&](const Row* a, const Row* b) { return spreadOf(*a) < spreadOf(*b); });
    const auto kernelOf = [&](const Row& row, double scale) {
        return lobeKernel(brdf, valuesAt(request, row.width), row.nodes, scale);
    };
    std::vector<Layer> layers;
    double least = HUGE_VAL;
    for (const SplitNode& node : sorted.front()->nodes)
        if (node.spread > 0.0) least = std::min(least, node.spread);
    const Layer narrowest{kernelOf(*sorted.front(), 1.0), 0.0};
    const double first = narrowest.kernel.spread();
    constexpr double kMostNarrowing = 0.4;
    for (double scale = std::max(least / first, kMostNarrowing); scale < 0.9; scale *= kStep) {
        ZonalKernel kernel = kernelOf(*sorted.front(), scale);
        const double spread = kernel.spread();
        if (spread > finest) layers.push_back({std::move(kernel), spread});
    }
    double last = 0.0;
    for (size_t i = 0; i < sorted.size(); ++i) {
        ZonalKernel kernel = kernelOf(*sorted[i], 1.0);
        const double spread = kernel.spread();
        const bool end = i + 1 == sorted.size();
        // All that are finer than the map's squares show the map itself.
        if (!end && spreadOf(*sorted[i + 1]) < finest) continue;
        if (!layers.empty() && i > 0 && !end && spread < last * (spread < kFineSpread ? 1.4 : 1.0) * kStep)
            continue;
        if (end && i > 0 && spread < last * 1.02) continue;
        layers.push_back({std::move(kernel), spread});
        last = spread;
    }
    while (layers.size() > kMostLayers)
        layers.erase(layers.begin());
    return layers;
}

/// Puts rectangles into rows, the tallest first.
class Packing {
public:
    explicit Packing(int width) : width_(width) {}
    std::pair<int, int> place(int width, int height) {
        if (x_ + width > width_) {
            y_ += shelf_;
            x_ = shelf_ = 0;
        }
        const std::pair at(x_, y_);
        x_ += width;
        shelf_ = std::max(shelf_, height);
        return at;
    }
    int height() const { return y_ + shelf_; }

private:
    int width_, x_ = 0, y_ = 0, shelf_ = 0;
};

class Picture {
public:
    explicit Picture(Prefiltered& result) : result_(result) {
        result_.texels.assign(static_cast<size_t>(result.width) * static_cast<size_t>(result.height) * 4,
                              0.0F);
    }
    float* at(int x, int y) {
        return &result_.texels[4 * (static_cast<size_t>(y) * static_cast<size_t>(result_.width) +
                                    static_cast<size_t>(x))];
    }
    void set(int x, int y, const glm::dvec3& rgb, double a) {
        float* texel = at(x, y);
        for (int c = 0; c < 3; ++c)
            texel[c] = static_cast<float>(rgb[c]);
        texel[3] = static_cast<float>(a);
    }
    void fill(const Square& square, const std::function<glm::dvec3(int, int)>& value) {
        const int size = square.size;
        inParallel(static_cast<size_t>(size), [&](size_t row) {
            const int y = static_cast<int>(row);
            for (int x = 0; x < size; ++x)
                set(square.x + 1 + x, square.y + 1 + y, value(x, y), 1.0);
        });
        for (int i = -1; i <= size; ++i)
            for (const auto& [x, y] :
                 {std::pair(i, -1), std::pair(i, size), std::pair(-1, i), std::pair(size, i)}) {
                const auto [fromX, fromY] = foldedSquare(x, y, size);
                std::copy_n(at(square.x + 1 + fromX, square.y + 1 + fromY), 4,
                            at(square.x + 1 + x, square.y + 1 + y));
            }
    }

private:
    Prefiltered& result_;
};

glm::vec3 directionOf(int x, int y, int size) {
    return glm::vec3(octahedralDirection({(2.0 * x + 1.0) / size - 1.0, (2.0 * y + 1.0) / size - 1.0}));
}

void fillTable(Picture& picture, const Prefiltered& result, const std::vector<Row>& rows,
               const std::vector<Layer>& layers) {
    for (int r = 0; r < result.tableRows; ++r)
        for (int n = 0; n < kAngles; ++n) {
            const SplitNode& node = rows[static_cast<size_t>(r)].nodes[static_cast<size_t>(n)];
            const int x = result.tableX + n, y = result.tableY + r;
            picture.set(x, y, node.albedo[0], node.base);
            picture.set(x + kAngles, y, node.albedo[1], 0.0);
            picture.set(x + 2 * kAngles, y,
                        {node.direction, layers.empty() ? 0.0 : placeAmong(layers, node.spread)}, 0.0);
        }
}

}  // namespace

Prefiltered prefiltered(const RadianceTree& tree, const Request& request) {
    const AreaModel& area = *request.lobe.brdf->area;
    Prefiltered result;
    const bool varies = request.lobe.widthVaries && request.widths.first < request.widths.second;
    std::vector<Row> rows(varies ? kTableWidths : 1);
    result.tableRows = static_cast<int>(rows.size());
    if (varies) {
        const double low = std::log(request.widths.first), high = std::log(request.widths.second);
        result.firstLogWidth = low;
        result.rowsPerLogWidth = (result.tableRows - 1) / (high - low);
    }
    inParallel(rows.size(), [&](size_t i) {
        rows[i].width = varies
                            ? std::exp(result.firstLogWidth + static_cast<double>(i) / result.rowsPerLogWidth)
                            : request.widths.first;
        rows[i].nodes = splitNodes(*request.lobe.brdf, valuesAt(request, rows[i].width));
    });
    const double finest = 1.8 / tree.size();  // half a square of the tree
    std::vector<Layer> layers;
    if (area.terms > 0) layers = layersFor(request, rows, finest);
    for (const Layer& layer : layers) {
        const int size = static_cast<int>(std::min(kSquaresPerSpread / layer.spread, 1e6));
        const int most = layer.spread < finest ? tree.size() : std::min(tree.size(), kMostBlurred);
        result.layers.push_back({0, 0, std::clamp(size, kLeastLayer, most)});
    }
    if (request.irradiance) result.irradiance.size = kIrradianceSize;

    int widest = std::max(3 * kAngles, result.irradiance.size + 2);
    for (const Square& layer : result.layers)
        widest = std::max(widest, layer.size + 2);
    Packing packing(widest);
    for (Square& layer : result.layers)
        std::tie(layer.x, layer.y) = packing.place(layer.size + 2, layer.size + 2);
    if (request.irradiance)
        std::tie(result.irradiance.x, result.irradiance.y) =
            packing.place(kIrradianceSize + 2, kIrradianceSize + 2);
    std::tie(result.tableX, result.tableY) = packing.place(3 * kAngles, result.tableRows);
    result.width = widest;
    result.height = packing.height();

    Picture picture(result);
    for (size_t i = 0; i < layers.size(); ++i) {
        const Square& square = result.layers[i];
        const bool itself = layers[i].spread < finest && square.size == tree.size();
        const RadianceTree::Rings rings(tree, layers[i].kernel);
        picture.fill(square, [&](int x, int y) {
            if (square.size > kLargestSummed && !itself) return rings.about(directionOf(x, y, square.size));
            if (itself) return glm::dvec3(tree.radiance(x, y));
            return tree.blurred(directionOf(x, y, square.size), layers[i].kernel);
        });
    }
    if (request.irradiance) {
        const ZonalKernel cosine([](double angle) { return std::max(std::cos(angle), 0.0); });
        picture.fill(result.irradiance,
                     [&](int x, int y) { return tree.blurred(directionOf(x, y, kIrradianceSize), cosine); });
    }
    fillTable(picture, result, rows, layers);
    return result;
}

}  // namespace lobe::environment
