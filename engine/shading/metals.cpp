#include "shading/metals.hpp"

#include "base/closest_name.hpp"
#include "base/error.hpp"

namespace lobe::shading {

const std::vector<Metal>& metals() {
    static const std::vector<Metal> table{
        {"silver", {0.1342, 0.1297, 0.1395}, {3.9628, 3.1942, 2.6135}},
        {"aluminium", {1.3571, 0.8843, 0.6605}, {7.5878, 6.4700, 5.6536}},
        {"gold", {0.1837, 0.4573, 1.3724}, {3.0663, 2.4084, 1.8250}},
        {"copper", {0.2459, 1.0723, 1.1569}, {3.3784, 2.5907, 2.4572}},
        {"chromium", {3.5573, 2.9788, 2.1255}, {4.3621, 4.4501, 4.3025}},
        {"nickel", {1.9618, 1.7375, 1.6466}, {3.7072, 3.1492, 2.7429}},
        {"tungsten", {3.6318, 3.4877, 3.3167}, {2.9091, 2.7200, 2.5768}},
        {"iridium", {2.5217, 2.1455, 1.8698}, {4.6041, 4.2224, 3.7728}},
        {"rhodium", {2.1448, 1.9275, 1.8165}, {5.5874, 4.8898, 4.5098}},
        {"molybdenum", {3.6986, 3.7273, 3.1596}, {3.5386, 3.6633, 3.5429}},
        {"mercury", {1.9648, 1.4615, 1.1307}, {5.2133, 4.5199, 3.9898}},
        {"titanium nitride", {1.3444, 1.2349, 1.4020}, {2.7447, 1.9527, 1.4218}},
        {"titanium", {2.18385, 1.8364, 1.72103}, {2.9550, 2.5188, 2.3034}},
        {"platinum", {2.35423, 2.06875, 1.88085}, {4.1988, 3.6120, 3.2271}},
    };
    return table;
}

const Metal& requireMetal(const std::string& name, const std::string& where) {
    std::vector<std::string> names;
    for (const Metal& metal : metals()) {
        if (metal.name == name) return metal;
        names.push_back(metal.name);
    }
    throw UsageError(where + " '" + name + "'; expected one of " + listed(names) + didYouMean(name, names));
}

const std::vector<NamedReflectance>& namedReflectances() {
    static const std::vector<NamedReflectance> table{
        {"water", {0.02, 0.02, 0.02}},   {"plastic", {0.03, 0.03, 0.03}}, {"glass", {0.08, 0.08, 0.08}},
        {"diamond", {0.17, 0.17, 0.17}}, {"gold", {1.00, 0.71, 0.29}},    {"silver", {0.95, 0.93, 0.88}},
        {"copper", {0.95, 0.64, 0.54}},  {"iron", {0.56, 0.57, 0.58}},    {"aluminium", {0.91, 0.92, 0.92}},
    };
    return table;
}

}  // namespace lobe::shading
