#include "reference/body_lamp.hpp"

#include <algorithm>

namespace lobe::reference {
namespace {

/// Share of draws by brightness; the others reach all of the light evenly.
constexpr double kByBrightness = 0.5;

/// The step of running sums that holds `value`, and how far within it.
std::pair<size_t, double> stepOf(const double* sums, size_t steps, double value) {
    const double* above = std::upper_bound(sums + 1, sums + steps, value);
    const auto step = static_cast<size_t>(above - sums) - 1;
    const double width = sums[step + 1] - sums[step];
    return {step, width > 0.0 ? std::clamp((value - sums[step]) / width, 0.0, 1.0) : 0.5};
}

}  // namespace

BodyImage::BodyImage(const Bitmap& bitmap) : image_(bitmap) {
    const int width = image_.width(), height = image_.height();
    const auto brightness = [&](int x, int y) {
        const glm::dvec3 rgb = image_.texel(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1));
        return rgb.x + rgb.y + rgb.z;
    };
    // Within half a texel of a centre, the bilinear's mean takes an eighth of each neighbour.
    const auto blurred = [](double before, double here, double after) {
        return (before + 6.0 * here + after) / 8.0;
    };
    const auto across = [&](int x, int y) {
        return blurred(brightness(x - 1, y), brightness(x, y), brightness(x + 1, y));
    };
    rows_.push_back(0.0);
    for (int y = 0; y < height; ++y) {
        double sum = 0.0;
        columns_.push_back(sum);
        for (int x = 0; x < width; ++x)
            columns_.push_back(sum += blurred(across(x, y - 1), across(x, y), across(x, y + 1)));
        rows_.push_back(rows_.back() + sum);
    }
}

glm::dvec2 BodyImage::draw(double u, double v) const {
    const auto width = static_cast<size_t>(image_.width()), height = static_cast<size_t>(image_.height());
    const auto [y, inRow] = stepOf(rows_.data(), height, v * rows_.back());
    const double* columns = columns_.data() + y * (width + 1);
    const auto [x, inColumn] = stepOf(columns, width, u * columns[width]);
    return {(static_cast<double>(x) + inColumn) / static_cast<double>(width),
            (static_cast<double>(y) + inRow) / static_cast<double>(height)};
}

double BodyImage::density(const glm::dvec2& place) const {
    const auto index = [](double at, int count) {
        return static_cast<size_t>(std::clamp(static_cast<int>(at * count), 0, count - 1));
    };
    const size_t x = index(place.x, image_.width()), y = index(place.y, image_.height());
    const double* columns = columns_.data() + y * (static_cast<size_t>(image_.width()) + 1);
    return (columns[x + 1] - columns[x]) / rows_.back() * image_.width() * image_.height();
}

BodySample BodyLamp::draw(double u, double v, double w) const {
    if (image_ == nullptr || image_->black()) return view_.draw(u, v, w);
    BodySample sample;
    if (w < kByBrightness) {
        const glm::dvec2 at = image_->draw(u, v);
        const glm::dvec3 target = light_.position - point_ + (0.5 - at.x) * light_.width * light_.axis +
                                  (at.y - 0.5) * light_.height * glm::cross(light_.direction, light_.axis);
        sample.distance = glm::length(target);
        if (!(sample.distance > 0.0)) return {};
        sample.direction = target / sample.distance;
    } else {
        sample = view_.draw(u, v, w);
        if (sample.solidAngle == 0.0) return sample;
    }
    const double density = (1.0 - kByBrightness) * view_.density(sample.direction) +
                           kByBrightness * imageDensity(sample.direction, sample.distance);
    sample.solidAngle = density > 0.0 ? 1.0 / density : 0.0;
    return sample;
}

double BodyLamp::density(const glm::dvec3& direction) const {
    if (image_ == nullptr || image_->black()) return view_.density(direction);
    const auto distance = view_.distanceAlong(direction);
    return distance ? (1.0 - kByBrightness) * view_.density(direction) +
                          kByBrightness * imageDensity(direction, *distance)
                    : 0.0;
}

double BodyLamp::imageDensity(const glm::dvec3& direction, double distance) const {
    const double facing = -glm::dot(direction, light_.direction);
    if (!(facing > 0.0)) return 0.0;
    return image_->density(place(direction, distance)) * distance * distance /
           (light_.width * light_.height * facing);
}

glm::dvec2 BodyLamp::place(const glm::dvec3& direction, double distance) const {
    return placeOnImage(light_, direction * distance - (light_.position - point_));
}

glm::dvec3 BodyLamp::radiance(const glm::dvec3& direction, double distance) const {
    return image_ == nullptr ? radiance_ : radiance_ * image_->image().at(place(direction, distance));
}

std::pair<glm::dvec3, double> BodyLamp::towards(const glm::dvec3& direction) const {
    const auto distance = view_.distanceAlong(direction);
    return distance ? std::pair(radiance(direction, *distance), *distance) : std::pair(glm::dvec3(0.0), 0.0);
}

}  // namespace lobe::reference
