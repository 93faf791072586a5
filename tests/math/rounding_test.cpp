/// Doubles rounded to floats are what twins and GLSL have in common: the compiler must really round them.
#include <gtest/gtest.h>

namespace lobe {
namespace {

struct Pair {
    double a, b;
};

#if defined(__GNUC__)
__attribute__((noinline))
#endif
Pair roundedToFloats(Pair pair) {
    pair.a = double(static_cast<float>(pair.a));
    pair.b = double(static_cast<float>(pair.b));
    return pair;
}

TEST(Rounding, ToFloatAndBackIsNotLeftOut) {
    const Pair rounded = roundedToFloats({0.1, 0.3});
    EXPECT_EQ(rounded.a, 0x1.99999ap-4);
    EXPECT_EQ(rounded.b, 0x1.333334p-2);
}

}  // namespace
}  // namespace lobe
