#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "framegraph/compile/compile.h"
#include "framegraph/compile/heap_packing.h"
#include "framegraph/verify/verify.h"
#include "tests/framegraph/random_graph.h"

/// Tests the placement of transients for a device with unusual requirements.
namespace fg {
namespace {

/// A device with sizes that are no multiple of the alignment, with several memory classes, and with pages that buffers
/// and images must not share.
class AwkwardModel final : public MemoryModel {
 public:
  static constexpr std::uint64_t kGranularity = 4096;
  static constexpr std::uint64_t kTextureAlignment = 1024;
  static constexpr std::uint64_t kBufferAlignment = 64;

  [[nodiscard]] MemoryRequirements texture(const TextureDesc& desc, VkImageUsageFlags usage) const override {
    const bool attachment = (usage & VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT) != 0;
    return {texelBytes(desc, {}) + 100, kTextureAlignment, attachment ? 0b1000U : 0b0111U};
  }
  [[nodiscard]] MemoryRequirements buffer(const BufferDesc& desc, VkBufferUsageFlags usage) const override {
    const bool indirect = (usage & VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT) != 0;
    return {desc.size + 4, kBufferAlignment, indirect ? 0b0010U : 0b0111U};
  }
  [[nodiscard]] bool supports(VkFormat /*format*/, VkImageUsageFlags /*usage*/) const override { return true; }
  [[nodiscard]] std::uint64_t bufferImageGranularity() const override { return kGranularity; }
};

struct Placed {
  const PlannedResource* resource;
  bool isBuffer;
};

std::vector<Placed> placed(const GraphDesc& graph, const Plan& plan) {
  std::vector<Placed> result;
  for (std::size_t i = 0; i < plan.resources.size(); ++i) {
    if (plan.resources[i].heap == kNone) continue;
    result.push_back({&plan.resources[i], std::holds_alternative<BufferDesc>(graph.resources[i].desc)});
  }
  return result;
}

/// True if some batch lies in the lifetimes of both.
bool aliveTogether(const Plan& plan, const PlannedResource& a, const PlannedResource& b) {
  const auto batch = [&](std::uint32_t position) { return plan.passes[position].batch; };
  return batch(a.firstUse) <= batch(b.lastUse) && batch(b.firstUse) <= batch(a.lastUse);
}

/// True if two blocks overlap the same page.
/// @param page size in bytes
bool sharePage(const PlannedResource& a, const PlannedResource& b, std::uint64_t page) {
  return a.offset / page <= (b.offset + b.size - 1) / page && b.offset / page <= (a.offset + a.size - 1) / page;
}

TEST(Placement, KeepsToAlignmentMemoryClassAndGranularity) {
  std::uint64_t mixedPairs = 0;
  constexpr std::uint64_t kGraphs = 500;
  for (std::uint64_t seed = 1; seed <= kGraphs; ++seed) {
    const Graph graph = test::randomGraph(seed, {4, 24});
    const CompileResult result = compile(graph.desc(), AwkwardModel());
    ASSERT_TRUE(result.ok()) << result.text();
    ASSERT_TRUE(verify(graph.desc(), result.plan).empty()) << "seed " << seed;
    const std::vector<Placed> all = placed(graph.desc(), result.plan);
    for (const Placed& a : all) {
      const PlannedResource& x = *a.resource;
      EXPECT_EQ(x.offset % (a.isBuffer ? AwkwardModel::kBufferAlignment : AwkwardModel::kTextureAlignment), 0U);
      EXPECT_EQ(result.plan.heaps[x.heap].memoryTypeBits, x.memoryTypeBits);
      EXPECT_LE(x.offset + x.size, result.plan.heaps[x.heap].size);
      for (const Placed& b : all) {
        const PlannedResource& y = *b.resource;
        if (a.resource == b.resource || x.heap != y.heap || !aliveTogether(result.plan, x, y)) continue;
        const std::uint64_t page = a.isBuffer == b.isBuffer ? 1 : AwkwardModel::kGranularity;
        mixedPairs += page != 1 ? 1 : 0;
        EXPECT_FALSE(sharePage(x, y, page)) << "seed " << seed << " on pages of " << page << " bytes";
      }
    }
  }
  EXPECT_GT(mixedPairs, 100U);
}

/// Exactly seven bytes are needed at every position, so that an optimal packing has no gap.
TEST(HeapPacking, ReachesTheLowerBoundOfAFullHeap) {
  const std::vector<HeapRequest> requests = {
      {4, 1, 0, 1}, {3, 1, 1, 2}, {3, 1, 0, 0}, {4, 1, 2, 3}, {2, 1, 3, 3}, {1, 1, 3, 3},
  };
  const HeapPacking packing = pack(requests);
  EXPECT_EQ(packing.size, lowerBound(requests));
  EXPECT_EQ(lowerBound(requests), 7U);
}

TEST(HeapPacking, OfNoRequestsIsEmpty) {
  EXPECT_EQ(pack({}).size, 0U);
}

}  // namespace
}  // namespace fg
