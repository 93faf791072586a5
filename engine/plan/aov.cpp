#include "plan/aov.hpp"

namespace lobe {

const std::vector<std::string>& aovNames() {
    static const std::vector<std::string> names = {"radiance", "depth",       "position",  "normal",
                                                   "albedo",   "material_id", "roughness", "contributions"};
    return names;
}

}  // namespace lobe
