#include "passes/light_atlas.hpp"

#include <gtest/gtest.h>

#include <set>

namespace lobe {
namespace {

TEST(LightImageLayout, LevelsLieBesideOneAnotherAndEndWithTheImage) {
    for (const glm::ivec2 size :
         {glm::ivec2(1, 1), {2, 1}, {96, 64}, {5, 31}, {64, 1}, {1, 64}, {17, 16}, {33, 7}})
        for (const double aspect : {1.0, 1.5, 4.0, 0.25, 20.0, 0.01, 1e4}) {
            const LightImageLayout layout(size, aspect);
            ASSERT_GE(layout.turn, -2);
            ASSERT_LE(layout.turn, 2);
            EXPECT_EQ(layout.sizeOf(layout.last), size);
            EXPECT_EQ(layout.cornerOf(layout.last), glm::ivec2(0));
            if (layout.last > 0) {
                EXPECT_EQ(layout.sizeOf(0), glm::ivec2(1));
            }
            const glm::ivec2 block = layout.block();
            std::set<std::pair<int, int>> taken;
            for (int level = 0; level <= layout.last; ++level) {
                const glm::ivec2 corner = layout.cornerOf(level), parts = layout.sizeOf(level);
                for (int y = 0; y < parts.y; ++y)
                    for (int x = 0; x < parts.x; ++x)
                        ASSERT_TRUE(taken.emplace(corner.x + x, corner.y + y).second) << "level " << level;
                EXPECT_LE(corner.x + parts.x, block.x);
                EXPECT_LE(corner.y + parts.y, block.y);
                // No level has more than twice the parts of the one before, along either side.
                if (level > 0) {
                    EXPECT_TRUE(glm::all(glm::lessThanEqual(parts, 2 * layout.sizeOf(level - 1))));
                    EXPECT_TRUE(glm::all(glm::greaterThanEqual(parts, layout.sizeOf(level - 1))));
                }
                // shaders/glsl/light/light_image.glsl finds the same row in closed form.
                if (level < layout.last) {
                    const int from = level - layout.behind.y;
                    const int above = std::min(level, layout.behind.y) +
                                      (1 << std::clamp(from, 0, layout.full.y)) - 1 +
                                      std::max(from - layout.full.y, 0) * size.y;
                    EXPECT_EQ(corner, glm::ivec2(size.x, above))
                        << size.x << " x " << size.y << ", " << level;
                }
            }
        }
}

TEST(LightImageLayout, LongRectsHaveMorePartsAlongTheirLongerSide) {
    EXPECT_EQ(LightImageLayout({64, 64}, 1.0).sizeOf(2), glm::ivec2(4, 4));
    EXPECT_EQ(LightImageLayout({64, 64}, 4.0).sizeOf(3), glm::ivec2(8, 2));
    EXPECT_EQ(LightImageLayout({64, 64}, 16.0).sizeOf(4), glm::ivec2(16, 1));
    EXPECT_EQ(LightImageLayout({64, 64}, 1.0 / 16.0).sizeOf(4), glm::ivec2(1, 16));
}

}  // namespace
}  // namespace lobe
