/// Octahedral codes: how far a direction turns on its way through the G-buffer.
#include <gtest/gtest.h>

#include <cmath>

#include "harness/evaluator.hpp"
#include "math/random.hpp"
#include "math/sphere.hpp"
#include "math/ulp.hpp"
#include "on_contexts.hpp"

namespace lobe {
namespace {

class Octahedral : public test::OnContext {
protected:
    harness::Evaluator function(const std::string& name, const char* type, const std::string& call) const {
        return {library(),
                {name, {"common/octahedral.glsl"}, {{type, "v"}}, "    result[0]." + call + ";", 1, {}}};
    }

    /// The decoded directions through what an unsigned normalised target of `bits` keeps; 32: float.
    std::vector<glm::dvec3> roundTrip(const std::vector<glm::vec3>& directions, int bits) const {
        const bool unorm = bits < 32;
        const double steps = std::exp2(bits) - 1.0;
        std::vector<float> inputs;
        for (const glm::vec3& n : directions)
            inputs.insert(inputs.end(), {n.x, n.y, n.z});
        const std::string suffix = unorm ? "_unorm" + std::to_string(bits) + "(v)" : "(v)";
        const auto codes = function("encode", "vec3", "xy = octahedral_encode" + suffix).evaluate(inputs);
        inputs.clear();
        for (size_t i = 0; i < codes.rows(); ++i)
            for (int c = 0; c < 2; ++c) {
                const float code = codes.row(i)[static_cast<size_t>(c)];
                EXPECT_GE(code, unorm ? 0.0f : -1.0f);
                EXPECT_LE(code, 1.0f);
                inputs.push_back(unorm ? static_cast<float>(std::round(double(code) * steps) / steps) : code);
            }
        const auto decoded = function("decode", "vec2", "xyz = octahedral_decode" + suffix).evaluate(inputs);
        std::vector<glm::dvec3> result;
        for (size_t i = 0; i < decoded.rows(); ++i)
            result.emplace_back(decoded.row(i)[0], decoded.row(i)[1], decoded.row(i)[2]);
        return result;
    }
};

std::vector<glm::vec3> axesAndSeams() {
    std::vector<glm::vec3> directions;
    for (float x : {-1.0f, 0.0f, 1.0f})
        for (float y : {-1.0f, 0.0f, 1.0f})
            for (float z : {-1.0f, -1e-7f, -1e-20f, 0.0f, 1e-7f, 1.0f})
                if (x != 0.0f || y != 0.0f || std::abs(z) == 1.0f)
                    directions.push_back(glm::normalize(glm::vec3(x, y, z)));
    return directions;
}

double angle(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

struct Turn {
    double mean = 0.0, largest = 0.0, lengthError = 0.0;
};

Turn turnOf(const std::vector<glm::vec3>& from, const std::vector<glm::dvec3>& to) {
    Turn turn;
    for (size_t i = 0; i < from.size(); ++i) {
        const double a = angle(glm::dvec3(from[i]), to[i]);
        turn.mean += a / static_cast<double>(from.size());
        turn.largest = std::max(turn.largest, a);
        turn.lengthError = std::max(turn.lengthError, std::abs(glm::length(to[i]) - 1.0));
    }
    return turn;
}

std::vector<glm::vec3> directionsOverTheSphere(int count) {
    Pcg32 random(21);
    std::vector<glm::vec3> directions = axesAndSeams();
    for (int i = 0; i < count; ++i)
        directions.emplace_back(uniformSphere({random.uniform(), random.uniform()}));
    return directions;
}

/// Known of 2 x 16 bits over 2e6 directions: 2.28e-5 rad on average, 6.4e-5 at most. The largest turn is at a
/// diagonal, where half a step in both coordinates is sqrt(2) / 65534 / min |dp/dn|; sampling finds a little
/// less.
TEST_P(Octahedral, SixteenBitsTurnByTheKnownAngle) {
    const auto directions = directionsOverTheSphere(test::tableScale(400000));
    const Turn turn = turnOf(directions, roundTrip(directions, 16));
    EXPECT_LE(turn.largest, 6.45e-5);
    EXPECT_GE(turn.largest, 5e-5);
    EXPECT_NEAR(turn.mean, 2.28e-5, 0.05e-5);
    EXPECT_LT(turn.lengthError, 3 * kFloatRounding * 2);
    std::printf("octahedral 2x16: mean %.3e, largest %.3e rad\n", turn.mean, turn.largest);
}

/// The same steps 32767 / 127 times as wide.
TEST_P(Octahedral, EightBitsTurnByTheKnownAngle) {
    const auto directions = directionsOverTheSphere(test::tableScale(400000));
    const Turn turn = turnOf(directions, roundTrip(directions, 8));
    EXPECT_LE(turn.largest, 1.7e-2);
    EXPECT_GE(turn.largest, 5e-5 * 32767.0 / 127.0);
    EXPECT_NEAR(turn.mean, 2.28e-5 * 32767.0 / 127.0, 0.05e-5 * 32767.0 / 127.0);
    EXPECT_LT(turn.lengthError, 3 * kFloatRounding * 2);
    std::printf("octahedral 2x8: mean %.3e, largest %.3e rad\n", turn.mean, turn.largest);
}

TEST_P(Octahedral, FloatsTurnByRoundingOnly) {
    const auto directions = directionsOverTheSphere(test::tableScale(400000));
    const Turn turn = turnOf(directions, roundTrip(directions, 32));
    EXPECT_LE(turn.largest, 3.2e-7);
    EXPECT_LE(turn.mean, 7e-8);
    EXPECT_LT(turn.lengthError, 3 * kFloatRounding * 2);
    std::printf("octahedral 2x32F: mean %.3e, largest %.3e rad\n", turn.mean, turn.largest);
}

TEST_P(Octahedral, AxesAreExact) {
    const std::vector<glm::vec3> axes{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int bits : {8, 16, 32}) {
        const std::vector<glm::dvec3> decoded = roundTrip(axes, bits);
        for (size_t i = 0; i < axes.size(); ++i)
            EXPECT_EQ(decoded[i], glm::dvec3(axes[i])) << i;
    }
}

LOBE_ON_EVERY_BACKEND(Octahedral);

}  // namespace
}  // namespace lobe
