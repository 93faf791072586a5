/// Which quantity of a picture is shown, and how it becomes colours.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "image/image.hpp"
#include "plan/plan.hpp"
#include "settings.hpp"

namespace lobe::view {

/// Radiance, another AOV, or one contribution to radiance.
struct Shown {
    Aov aov = Aov::radiance;
    std::string contribution;  ///< "directional"; only with Aov::contributions

    bool operator==(const Shown&) const = default;
};

/// For people: "picture", "normal", "light of point".
std::string nameOf(const Shown& shown);

/// All that can be shown of a scene that is drawn by this plan; `contributions` are those that it has.
std::vector<Shown> shownChoices(const FramePlan& plan);

/// Names of the contributions that a scene's radiance consists of, whether the plan keeps them apart or not.
std::vector<std::string> contributionsOf(const FramePlan& plan);

/// What the colours of a false-colour picture stand for.
struct Legend {
    bool used = false, logarithmic = false;
    double low = 0.0, high = 1.0;  ///< at the dark and at the light end
    std::string quantity;          ///< "depth [m]"
};

struct Display {
    Bitmap bitmap;  ///< 8 bits, 3 or 4 channels
    Legend legend;
};

/// Colours of what is shown. Radiance and its parts: exactly as `lobe render` writes them to PNG. Throws
/// InputError where the image lacks the channels.
Display displayOf(const Image& image, const Shown& shown, const app::Settings& settings);

/// Viridis, from 0 dark to 1 light.
std::array<uint8_t, 3> falseColor(double share);

}  // namespace lobe::view
