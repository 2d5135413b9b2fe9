#include "passes/conventions/light_pattern.h"

#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/error_text.h"

namespace walr {
namespace {

const std::vector<LightPattern> kPatterns{{1, 1}, {2, 1}, {1, 2}, {3, 1}, {2, 2}, {2, 3}, {3, 2}, {3, 3}};

// Over as many frames as a group has pixels, every pixel of an image is that of one texel exactly once, whatever the
// size of the image.
TEST(LightPattern, VisitsEveryPixelOnce) {
  constexpr fg::Extent kImage{11, 7};
  for (const LightPattern& pattern : kPatterns) {
    SCOPED_TRACE(testing::Message() << pattern.columns << " x " << pattern.rows);
    const fg::Extent light = pattern.lightingExtent(kImage);
    std::multiset<std::pair<int, int>> visited;
    for (std::uint32_t frame = 0; frame < pattern.columns * pattern.rows; ++frame) {
      const glm::ivec2 offset = lightOffsetOfFrame(pattern, frame);
      EXPECT_NO_THROW(checkLightOffset(pattern, offset));
      for (std::uint32_t y = 0; y < light.height; ++y) {
        for (std::uint32_t x = 0; x < light.width; ++x) {
          const glm::ivec2 p = pattern.pixelOf(glm::ivec2(x, y), offset);
          EXPECT_EQ(p / glm::ivec2(pattern.columns, pattern.rows), glm::ivec2(x, y));
          if (p.x < int(kImage.width) && p.y < int(kImage.height)) visited.emplace(p.x, p.y);
        }
      }
    }
    EXPECT_EQ(visited.size(), std::size_t(kImage.width) * kImage.height);
    EXPECT_EQ(std::set(visited.begin(), visited.end()).size(), visited.size());
  }
}

TEST(LightPattern, AGroupOfTwoPixelsInARowIsACheckerboard) {
  const LightPattern pattern{2, 1};
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) EXPECT_EQ((pattern.pixelOf({x, y}, {1, 0}).x + y) % 2, 1);
  }
}

TEST(LightPattern, NamesWhatIsOutOfRange) {
  fg::test::expectError([] { checkLightPattern({4, 1}); }, {"4 x 1 pixels", "1 to 3"});
  fg::test::expectError([] { checkLightPattern({1, 0}); }, {"1 x 0 pixels", "1 to 3"});
  fg::test::expectError([] { checkLightOffset({2, 2}, {1, 2}); }, {"(1, 2) pixels", "group of 2 x 2"});
  fg::test::expectError([] { checkLightOffset({2, 2}, {-1, 0}); }, {"(-1, 0) pixels"});
}

}  // namespace
}  // namespace walr
