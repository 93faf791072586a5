#include <array>

#include "base/content_hash.hpp"
#include "base/resources.hpp"
#include "environment/prefiltered.hpp"
#include "fit/table_cache.hpp"

namespace lobe::environment {

std::string keyOf(const EnvironmentMap& map, const Request& request) {
    ContentHash hash;
    const std::string content = map.contentHash(), lobe = fit::tableKey(request.lobe);
    hash.add(std::as_bytes(std::span(content)));
    hash.add(std::as_bytes(std::span(lobe)));
    const std::array<double, 4> rest{kVersion, request.irradiance ? 1.0 : 0.0, request.widths.first,
                                     request.widths.second};
    hash.add(std::as_bytes(std::span(rest)));
    return hash.hex();
}

Cache::Cache() : Cache(cacheFolder("environment")) {}

std::optional<Prefiltered> Cache::find(const std::string& key) const {
    std::optional<KeptNumbers> kept = store_.find(key);
    if (!kept || kept->facts.size() < 10) return {};
    const auto whole = [&](size_t i) { return static_cast<int>(kept->facts[i]); };
    const auto square = [&](size_t i) { return Square{whole(i), whole(i + 1), whole(i + 2)}; };
    Prefiltered made;
    made.width = whole(0);
    made.height = whole(1);
    made.tableX = whole(2);
    made.tableY = whole(3);
    made.tableRows = whole(4);
    made.firstLogWidth = kept->facts[5];
    made.rowsPerLogWidth = kept->facts[6];
    made.irradiance = square(7);
    for (size_t i = 10; i + 2 < kept->facts.size(); i += 3)
        made.layers.push_back(square(i));
    made.texels = std::move(kept->values);
    return made;
}

void Cache::keep(const std::string& key, const Prefiltered& made) const {
    KeptNumbers numbers{{double(made.width), double(made.height), double(made.tableX), double(made.tableY),
                         double(made.tableRows), made.firstLogWidth, made.rowsPerLogWidth},
                        made.texels};
    const auto add = [&](const Square& square) {
        for (int number : {square.x, square.y, square.size})
            numbers.facts.push_back(number);
    };
    add(made.irradiance);
    for (const Square& layer : made.layers)
        add(layer);
    store_.keep(key, numbers);
}

}  // namespace lobe::environment
