#include "import/animation.hpp"

#include <algorithm>
#include <cmath>

#include "import/accessors.hpp"
#include "import/refuse.hpp"

namespace lobe {

namespace {

enum class Interpolation : uint8_t { linear, step, cubicSpline };

/// A sampler's keys, read whole: `values` has `width` numbers a value and, for cubic splines, three values a
/// key (in-tangent, value, out-tangent).
struct Curve {
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times;
    std::vector<float> values;
    size_t width = 0;

    const float* value(size_t key) const {
        return values.data() + (interpolation == Interpolation::cubicSpline ? 3 * key + 1 : key) * width;
    }
    const float* inTangent(size_t key) const { return values.data() + 3 * key * width; }
    const float* outTangent(size_t key) const { return values.data() + (3 * key + 2) * width; }
};

/// Where a time lies: between `key` and the next one, at `fraction` of `length` seconds.
struct Place {
    size_t key = 0;
    double fraction = 0.0;
    double length = 0.0;
};

Place placeOf(const std::vector<float>& times, double time) {
    const auto after = std::upper_bound(times.begin(), times.end(), time,
                                        [](double wanted, float key) { return wanted < double{key}; });
    if (after == times.begin()) {
        return {};
    }
    const auto key = static_cast<size_t>(after - times.begin()) - 1;
    if (after == times.end()) {
        return {key, 0.0, 0.0};
    }
    const double length = double{times[key + 1]} - double{times[key]};
    return {key, (time - double{times[key]}) / length, length};
}

/// Hermite form of the glTF specification, appendix C.5.
double hermite(const Curve& curve, const Place& place, size_t component) {
    const double t = place.fraction;
    const double t2 = t * t;
    const double t3 = t2 * t;
    return (2.0 * t3 - 3.0 * t2 + 1.0) * double{curve.value(place.key)[component]} +
           place.length * (t3 - 2.0 * t2 + t) * double{curve.outTangent(place.key)[component]} +
           (3.0 * t2 - 2.0 * t3) * double{curve.value(place.key + 1)[component]} +
           place.length * (t3 - t2) * double{curve.inTangent(place.key + 1)[component]};
}

std::vector<double> evaluate(const Curve& curve, double time) {
    const Place place = placeOf(curve.times, time);
    std::vector<double> result(curve.width);
    for (size_t i = 0; i < curve.width; ++i) {
        const double before = double{curve.value(place.key)[i]};
        if (place.length == 0.0 || curve.interpolation == Interpolation::step) {
            result[i] = before;
        } else if (curve.interpolation == Interpolation::linear) {
            const double after = double{curve.value(place.key + 1)[i]};
            result[i] = before + (after - before) * place.fraction;
        } else {
            result[i] = hermite(curve, place, i);
        }
    }
    return result;
}

glm::dquat quaternion(const float* xyzw) {
    return {double{xyzw[3]}, double{xyzw[0]}, double{xyzw[1]}, double{xyzw[2]}};
}

/// Unit, or the identity in place of zero, which splines can pass through.
glm::dquat unit(const glm::dquat& q) {
    const double length = glm::length(q);
    return length > 0.0 ? q / length : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

glm::dquat evaluateRotation(const Curve& curve, double time) {
    const Place place = placeOf(curve.times, time);
    if (curve.interpolation == Interpolation::linear && place.length != 0.0) {
        // The shorter way round, at constant speed.
        return unit(glm::slerp(unit(quaternion(curve.value(place.key))),
                               unit(quaternion(curve.value(place.key + 1))), place.fraction));
    }
    const std::vector<double> q = evaluate(curve, time);
    return unit({q[3], q[0], q[1], q[2]});
}

class Reader {
public:
    Reader(Document& document, size_t animation) : document_(document), animation_(animation) {}

    /// `perKey` values make one key (morph weights are stored one by one); `type` is theirs.
    Curve read(size_t samplerIndex, int type, size_t perKey, bool mayBeNormalized) const {
        const tinygltf::AnimationSampler& sampler =
            document_.model.animations[animation_].samplers[samplerIndex];
        const std::string property = at("animations", animation_, at("samplers", samplerIndex));
        Curve curve;
        curve.interpolation = sampler.interpolation == "STEP"          ? Interpolation::step
                              : sampler.interpolation == "CUBICSPLINE" ? Interpolation::cubicSpline
                                                                       : Interpolation::linear;
        curve.times = readTimes(sampler.input, property + ".input");
        std::vector<int> componentTypes{TINYGLTF_COMPONENT_TYPE_FLOAT};
        if (mayBeNormalized) {
            componentTypes.insert(componentTypes.end(),
                                  {TINYGLTF_COMPONENT_TYPE_BYTE, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
                                   TINYGLTF_COMPONENT_TYPE_SHORT, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT});
        }
        checkUse(document_, sampler.output,
                 {property + ".output", type, componentTypes, AccessorUse::Normalized::integersMust});
        const tinygltf::Accessor& output = document_.model.accessors[static_cast<size_t>(sampler.output)];
        const size_t tangents = curve.interpolation == Interpolation::cubicSpline ? 3 : 1;
        if (output.count != curve.times.size() * perKey * tangents) {
            refuse(document_.file, property + ".output", std::to_string(output.count) + " values",
                   std::to_string(curve.times.size() * perKey * tangents) + " for " +
                       std::to_string(curve.times.size()) + " keys");
        }
        curve.values = readFloats(document_, sampler.output);
        curve.width = componentCount(output) * perKey;
        return curve;
    }

private:
    std::vector<float> readTimes(int accessor, const std::string& property) const {
        checkUse(document_, accessor, {property, TINYGLTF_TYPE_SCALAR, {TINYGLTF_COMPONENT_TYPE_FLOAT}});
        std::vector<float> times = readFloats(document_, accessor);
        for (size_t i = 0; i < times.size(); ++i) {
            if (times[i] < 0.0f || (i > 0 && times[i] <= times[i - 1])) {
                refuse(document_.file, property + ", key " + std::to_string(i), static_cast<double>(times[i]),
                       "times that grow from key to key, from 0 s or later");
            }
        }
        return times;
    }

    Document& document_;
    size_t animation_;
};

/// How many weights a node's mesh takes.
size_t morphTargets(const Document& document, int node) {
    const int mesh = document.model.nodes[static_cast<size_t>(node)].mesh;
    return mesh < 0 ? 0 : document.model.meshes[static_cast<size_t>(mesh)].primitives.front().targets.size();
}

/// Moves one property of one node; returns the time of the last key.
double applyChannel(Document& document, size_t animation, size_t channelIndex, double time,
                    std::vector<NodePose>& pose) {
    const tinygltf::Animation& source = document.model.animations[animation];
    const tinygltf::AnimationChannel& channel = source.channels[channelIndex];
    const std::string property = at("animations", animation, at("channels", channelIndex));
    if (static_cast<size_t>(channel.sampler) >= source.samplers.size()) {
        refuse(document.file, property + ".sampler", std::to_string(channel.sampler),
               "an index into the animation's " + std::to_string(source.samplers.size()) + " samplers");
    }
    if (channel.target_node < 0) {
        return 0.0;  // glTF: to be ignored
    }
    NodePose& node = pose[static_cast<size_t>(channel.target_node)];
    const auto sampler = static_cast<size_t>(channel.sampler);
    const Reader reader(document, animation);
    const std::string& path = channel.target_path;
    if (path != "weights" && node.matrix) {
        refuse(document.file, property + ".target.node", std::to_string(channel.target_node),
               "a node with translation, rotation and scale, not a matrix");
    }
    Curve curve;
    if (path == "translation" || path == "scale") {
        curve = reader.read(sampler, TINYGLTF_TYPE_VEC3, 1, false);
        const std::vector<double> v = evaluate(curve, time);
        (path == "scale" ? node.scale : node.translation) = {v[0], v[1], v[2]};
    } else if (path == "rotation") {
        curve = reader.read(sampler, TINYGLTF_TYPE_VEC4, 1, true);
        node.rotation = evaluateRotation(curve, time);
    } else if (path == "weights") {
        const size_t targets = morphTargets(document, channel.target_node);
        if (targets == 0) {
            refuse(document.file, property + ".target", "weights of a node without morph targets",
                   "a node whose mesh has them");
        }
        curve = reader.read(sampler, TINYGLTF_TYPE_SCALAR, targets, true);
        node.weights = evaluate(curve, time);
    } else {
        document.warn(property + ".target.path", "'" + path + "' is not supported and left out");
        return 0.0;
    }
    return double{curve.times.back()};
}

}  // namespace

std::vector<double> animate(Document& document, double time, std::vector<NodePose>& pose) {
    std::vector<double> durations;
    for (size_t i = 0; i < document.model.animations.size(); ++i) {
        double duration = 0.0;
        for (size_t c = 0; c < document.model.animations[i].channels.size(); ++c) {
            duration = std::max(duration, applyChannel(document, i, c, time, pose));
        }
        durations.push_back(duration);
    }
    return durations;
}

}  // namespace lobe
