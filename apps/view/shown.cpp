#include "shown.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "image/tone.hpp"
#include "plot/style.hpp"

namespace lobe::view {
namespace {

/// Where a channel is, or InputError.
size_t channelAt(const Image& image, const std::string& name) {
    const auto found = std::find(image.channels.begin(), image.channels.end(), name);
    if (found == image.channels.end()) throw InputError("the picture has no channel " + name);
    return static_cast<size_t>(found - image.channels.begin());
}

Bitmap blank(const Image& image) {
    Bitmap bitmap{image.width, image.height, 3, ComponentType::u8, {}};
    bitmap.data.resize(3 * image.pixelCount());
    return bitmap;
}

void put(Bitmap& bitmap, size_t pixel, const std::array<uint8_t, 3>& color) {
    for (size_t c = 0; c < 3; ++c)
        bitmap.data[3 * pixel + c] = static_cast<std::byte>(color[c]);
}

Display toneMapped(const Image& image, const app::Settings& settings) {
    const app::Background background = app::backgroundOf(settings);
    return {toDisplay(image, static_cast<float>(settings.get("exposure").get<double>()),
                      app::toneMappingOf(settings), background.transparent, background.color),
            {}};
}

/// One contribution as a picture of its own, opaque where the whole is.
Image contributionOf(const Image& image, const std::string& name) {
    Image part(image.width, image.height, {"R", "G", "B", "A"});
    const std::array<size_t, 4> from = {channelAt(image, name + ".R"), channelAt(image, name + ".G"),
                                        channelAt(image, name + ".B"), channelAt(image, "A")};
    for (size_t i = 0; i < image.pixelCount(); ++i)
        for (size_t c = 0; c < 4; ++c)
            part.values[4 * i + c] = image.values[i * image.channelCount() + from[c]];
    return part;
}

/// A quantity by false colours between its least and its largest value; 0 is nothing, and black, if asked.
Display inFalseColors(const Image& image, const std::string& channel, const std::string& quantity,
                      bool zeroIsNothing, std::optional<std::pair<double, double>> range) {
    const size_t at = channelAt(image, channel);
    const auto valueOf = [&](size_t i) {
        return static_cast<double>(image.values[i * image.channelCount() + at]);
    };
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (size_t i = 0; i < image.pixelCount(); ++i) {
        const double value = valueOf(i);
        if (!std::isfinite(value) || (zeroIsNothing && value == 0.0)) continue;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    if (range) std::tie(low, high) = *range;
    if (!(low <= high)) low = 0.0, high = 1.0;
    Display display{blank(image), {true, false, low, high, quantity}};
    for (size_t i = 0; i < image.pixelCount(); ++i) {
        const double value = valueOf(i);
        if (zeroIsNothing && value == 0.0) continue;
        put(display.bitmap, i, falseColor(high > low ? (value - low) / (high - low) : 0.5));
    }
    return display;
}

uint8_t code(double value) {
    return static_cast<uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}

/// Three channels as colours: x' = scale x + offset.
Display asColors(const Image& image, const std::array<std::string, 3>& names, bool srgb,
                 const std::array<double, 3>& scale, const std::array<double, 3>& offset) {
    std::array<size_t, 3> at{};
    for (size_t c = 0; c < 3; ++c)
        at[c] = channelAt(image, names[c]);
    Display display{blank(image), {}};
    for (size_t i = 0; i < image.pixelCount(); ++i) {
        std::array<uint8_t, 3> color{};
        bool nothing = true;
        for (size_t c = 0; c < 3; ++c) {
            const auto value = static_cast<double>(image.values[i * image.channelCount() + at[c]]);
            nothing = nothing && value == 0.0;
            color[c] = srgb ? encodeSrgb8(static_cast<float>(value)) : code(scale[c] * value + offset[c]);
        }
        if (!nothing) put(display.bitmap, i, color);
    }
    return display;
}

/// Each axis over the range that it has in the picture.
Display positions(const Image& image) {
    const std::array<std::string, 3> names = {"position.X", "position.Y", "position.Z"};
    std::array<double, 3> scale{}, offset{};
    for (size_t c = 0; c < 3; ++c) {
        const size_t at = channelAt(image, names[c]);
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (size_t i = 0; i < image.pixelCount(); ++i) {
            const auto value = static_cast<double>(image.values[i * image.channelCount() + at]);
            low = std::min(low, value);
            high = std::max(high, value);
        }
        scale[c] = high > low ? 1.0 / (high - low) : 0.0;
        offset[c] = -low * scale[c];
    }
    return asColors(image, names, false, scale, offset);
}

/// Numbers as colours that differ as much as they can from one to the next.
Display identities(const Image& image) {
    const size_t at = channelAt(image, "material.id");
    Display display{blank(image), {}};
    for (size_t i = 0; i < image.pixelCount(); ++i) {
        const auto id = static_cast<int>(image.values[i * image.channelCount() + at]);
        if (id <= 0) continue;
        const double hue = std::fmod(id * 0.618033988749895, 1.0) * 6.0;
        std::array<uint8_t, 3> color{};
        for (size_t c = 0; c < 3; ++c) {
            const double distance = std::abs(std::fmod(hue + 6.0 - 2.0 * static_cast<double>(c), 6.0) - 3.0);
            color[c] = code(0.25 + 0.75 * std::clamp(distance - 1.0, 0.0, 1.0));
        }
        put(display.bitmap, i, color);
    }
    return display;
}

}  // namespace

std::string nameOf(const Shown& shown) {
    if (shown.aov == Aov::radiance) return "picture";
    if (shown.aov == Aov::contributions) return "light: " + shown.contribution;
    std::string name = aovNames()[static_cast<size_t>(shown.aov)];
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
}

std::vector<std::string> contributionsOf(const FramePlan& plan) {
    if (!plan.contributionTargets.empty()) return plan.contributionTargets;
    std::vector<std::string> names;
    if (plan.ambient) names.emplace_back("ambient");
    for (const LightType type : {LightType::directional, LightType::point, LightType::spot, LightType::rect,
                                 LightType::disk, LightType::sphere, LightType::tube})
        if (plan.pass(std::string("light.") + lobe::nameOf(type)) != nullptr)
            names.emplace_back(lobe::nameOf(type));
    if (plan.pass("light.environment") != nullptr) names.emplace_back("environment");
    return names;
}

std::vector<Shown> shownChoices(const FramePlan& plan) {
    std::vector<Shown> choices;
    for (const Aov aov : {Aov::radiance, Aov::depth, Aov::position, Aov::normal, Aov::albedo, Aov::materialId,
                          Aov::roughness})
        choices.push_back({aov, {}});
    for (const std::string& name : contributionsOf(plan))
        choices.push_back({Aov::contributions, name});
    return choices;
}

std::array<uint8_t, 3> falseColor(double share) {
    static const std::array<std::array<uint8_t, 3>, 256> table = [] {
        std::array<std::array<uint8_t, 3>, 256> colors{};
        for (size_t i = 0; i < colors.size(); ++i) {
            const std::string text = plot::sequentialColor(static_cast<double>(i) / 255.0);  // #rrggbb
            for (size_t c = 0; c < 3; ++c)
                colors[i][c] = static_cast<uint8_t>(std::stoi(text.substr(1 + 2 * c, 2), nullptr, 16));
        }
        return colors;
    }();
    return table[code(std::isnan(share) ? 1.0 : share)];
}

Display displayOf(const Image& image, const Shown& shown, const app::Settings& settings) {
    constexpr std::array<double, 3> kOne = {1.0, 1.0, 1.0}, kHalf = {0.5, 0.5, 0.5}, kZero = {};
    switch (shown.aov) {
        case Aov::radiance:
            return toneMapped(image, settings);
        case Aov::depth:
            return inFalseColors(image, "depth.Z", "depth [m]", true, {});
        case Aov::position:
            return positions(image);
        case Aov::normal:
            return asColors(image, {"normal.X", "normal.Y", "normal.Z"}, false, kHalf, kHalf);
        case Aov::albedo:
            return asColors(image, {"albedo.R", "albedo.G", "albedo.B"}, true, kOne, kZero);
        case Aov::materialId:
            return identities(image);
        case Aov::roughness:
            return inFalseColors(image, "roughness.Y", "roughness", true, std::pair(0.0, 1.0));
        case Aov::contributions:
            break;
    }
    return toneMapped(contributionOf(image, shown.contribution), settings);
}

}  // namespace lobe::view
