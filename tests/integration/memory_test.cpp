// Device memory from a host's allocator, and memory that is known before it is allocated.
#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <walr/walr_passes.h>

#include "framegraph/vulkan/memory.h"
#include "passes/methods/denoiser.h"
#include "tests/integration/device_calls.h"
#include "tests/integration/hosted_run.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::memory_test {
namespace {

constexpr glm::ivec2 kSize(45, 37);

/// A host's allocator. All memory of the same memory types and required properties comes from one block, which begins
/// with bytes of the host.
class Suballocator {
 public:
  explicit Suballocator(const fg::vk::DeviceContext& device) : device_(&device) {}

  WalrMemoryCallbacks callbacks() {
    return {.struct_size = sizeof(WalrMemoryCallbacks), .reserved = 0, .user = this, .allocate = take, .free = give};
  }

  std::uint32_t calls = 0;
  std::uint32_t failAt = ~0U;  ///< Number of the call that fails, counted from 0.
  bool mapsNothing = false;
  std::uint64_t misplaced = 0;  ///< Added to every offset.
  std::uint64_t live = 0;       ///< Bytes that are not freed yet.
  [[nodiscard]] std::size_t blocks() const { return blocks_.size(); }

 private:
  static constexpr std::uint64_t kBlock = 1U << 24;
  static constexpr std::uint64_t kOwn = 4711;

  struct Block {
    fg::vk::DeviceMemory memory;
    std::uint64_t used = kOwn;
  };

  static VkResult take(void* user, const WalrMemoryRequest* request, WalrMemoryBlock* block) {
    return static_cast<Suballocator*>(user)->take(*request, *block);
  }
  static void give(void* user, const WalrMemoryBlock* block) {
    auto& self = *static_cast<Suballocator*>(user);
    const std::unique_ptr<WalrMemoryBlock> token(static_cast<WalrMemoryBlock*>(block->token));
    EXPECT_EQ(token->offset, block->offset);
    const auto size = self.sizes_.extract({block->memory, block->offset});
    ASSERT_FALSE(size.empty()) << "freed twice, or never allocated";
    self.live -= size.mapped();
  }

  VkResult take(const WalrMemoryRequest& request, WalrMemoryBlock& block) {
    EXPECT_EQ(request.struct_size, sizeof(request));
    EXPECT_EQ(block.memory, VkDeviceMemory(VK_NULL_HANDLE));
    EXPECT_EQ(request.size % device_->properties.limits.bufferImageGranularity, 0U);
    if (calls++ == failAt) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    const bool visible = (request.required & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0;
    auto& from = blocks_[{request.memory_type_bits, request.required}];
    if (from.used == kOwn) {
      from.memory =
          fg::vk::DeviceMemory(*device_, {kBlock, 1, request.memory_type_bits}, request.required, "the host's block");
    }
    block.offset = (from.used + request.alignment - 1) / request.alignment * request.alignment + misplaced;
    from.used = block.offset + request.size;
    if (from.used > kBlock) throw std::logic_error("the block is too small for the test");
    block.memory = from.memory.handle();
    block.mapped = visible && !mapsNothing ? from.memory.mapped() + block.offset : nullptr;
    block.token = std::make_unique<WalrMemoryBlock>(block).release();
    live += request.size;
    sizes_.emplace(std::pair(block.memory, block.offset), request.size);
    return VK_SUCCESS;
  }

  const fg::vk::DeviceContext* device_;
  /// By allowed memory types and required properties.
  std::map<std::pair<std::uint32_t, VkMemoryPropertyFlags>, Block> blocks_;
  std::map<std::pair<VkDeviceMemory, std::uint64_t>, std::uint64_t> sizes_;  ///< By memory and offset.
};

/// Results of frames with a new size and a setting that needs other textures between.
std::vector<std::vector<std::uint16_t>> walk(HostedRun& run) {
  std::vector<std::vector<std::uint16_t>> results;
  glm::ivec2 size = kSize;
  for (std::uint32_t i = 0; i < 6; ++i) {
    if (i == 2) require(walr_set_setting(run.denoiser(), "blocks.iterations", "1"));
    if (i == 4) {
      size = {40, 45};
      run.resize(size);
    }
    const glm::dvec3 step(0.06, 0.02, -0.03);
    const FrameDescription camera = cameraAt(double(i) * step, (double(i) - 1.0) * step, size, i);
    const reference::HostFrame frame = renderFrame(sphere(), camera, size);
    run.fill(frame);
    results.push_back(run.frame(camera));
  }
  return results;
}

WalrMemory memoryOf(WalrDenoiser denoiser) {
  WalrMemory memory{};
  memory.struct_size = sizeof(memory);
  require(walr_get_memory(denoiser, &memory));
  return memory;
}

class CApiMemory : public fg::test::GpuTest {
 protected:
  WalrDenoiserInfo info(const char* method) {
    device_ = hostDevice(device());
    WalrDenoiserInfo info = denoiserInfo(&device_, {640, 360});
    info.method = method;
    return info;
  }
  WalrDevice device_{};
};

TEST_F(CApiMemory, OfAHostThatSuballocatesGivesTheSamePixels) {
  HostedRun own(device(), "walr", kSize, {.lint = true, .counters = true});
  Suballocator memory(context());
  const WalrMemoryCallbacks callbacks = memory.callbacks();
  {
    HostedRun hosted(device(), "walr", kSize,
                     {.lint = true,
                      .counters = true,
                      .getInstanceProcAddr = countDeviceCalls(context().view.getInstanceProcAddr),
                      .deviceMemory = &callbacks});
    EXPECT_EQ(memory.calls, 0U);
    require(walr_prepare(hosted.denoiser()));
    EXPECT_EQ(memory.live, memoryOf(hosted.denoiser()).allocated);
    EXPECT_EQ(walk(hosted), walk(own));
    // What frames in flight may use is kept.
    require(walr_set_setting(hosted.denoiser(), "blocks.iterations", "2"));
    require(walr_prepare(hosted.denoiser()));
    const WalrMemory after = memoryOf(hosted.denoiser());
    EXPECT_EQ(memory.live, after.allocated + after.retired);
    EXPECT_GT(after.retired, 0U);
  }
  EXPECT_EQ(deviceCalls.bytes, 0U);
  EXPECT_EQ(memory.live, 0U);
}

TEST_F(CApiMemory, OfPassesComesFromTheHost) {
  Suballocator memory(context());
  const WalrMemoryCallbacks callbacks = memory.callbacks();
  WalrDenoiserInfo described = info("walr");
  described.lint = VK_TRUE;
  device_.get_instance_proc_addr = countDeviceCalls(context().view.getInstanceProcAddr);
  device_.device_memory = &callbacks;
  WalrPasses passes = nullptr;
  require(createPasses(described, passes));
  EXPECT_GT(memory.live, 0U);
  require(walr_destroy_passes(passes));
  EXPECT_EQ(memory.live, 0U);
  EXPECT_EQ(deviceCalls.bytes, 0U);
}

TEST_F(CApiMemory, ThatTheHostLacksIsAnErrorWithoutALeak) {
  Suballocator memory(context());
  const WalrMemoryCallbacks callbacks = memory.callbacks();
  HostedRun run(device(), "walr", kSize, {.lint = true, .deviceMemory = &callbacks});
  for (std::uint32_t failing = 0;; ++failing) {
    SCOPED_TRACE(failing);
    memory.calls = 0;
    memory.failAt = failing;
    const WalrResult result = walr_prepare(run.denoiser());
    if (result == WALR_SUCCESS) {
      EXPECT_GT(failing, 3U);  // Heaps, uploads, and two blocks of the linter.
      break;
    }
    ASSERT_EQ(result, WALR_ERROR_OUT_OF_MEMORY) << walr_last_error();
    const std::string text = walr_last_error();
    EXPECT_NE(text.find("WalrMemoryCallbacks::allocate, "), std::string::npos) << text;
    EXPECT_NE(text.find(" bytes for "), std::string::npos) << text;
    EXPECT_NE(text.find(": VK_ERROR_OUT_OF_DEVICE_MEMORY; try a smaller size"), std::string::npos) << text;
    EXPECT_EQ(memory.live, 0U);
  }
  memory.failAt = ~0U;
  EXPECT_EQ(walk(run).size(), 6U);
}

// The history goes on, too.
TEST_F(CApiMemory, ThatTheHostLacksForAChangeLeavesWhatWasInUse) {
  struct Change {
    glm::ivec2 size;
    const char* storage;
  };
  const auto run = [&](std::optional<Change> refused) {
    Suballocator memory(context());
    const WalrMemoryCallbacks callbacks = memory.callbacks();
    HostedRun hosted(device(), "walr", kSize, {.deviceMemory = &callbacks});
    const auto apply = [&](const Change& change) {
      require(walr_resize(hosted.denoiser(), static_cast<std::uint32_t>(change.size.x),
                          static_cast<std::uint32_t>(change.size.y)));
      require(walr_set_setting(hosted.denoiser(), "accumulation.storage", change.storage));
    };
    std::vector<std::uint16_t> result;
    for (std::uint32_t i = 0; i < 4; ++i) {
      if (i == 3 && refused) {
        const std::uint64_t before = memory.live;
        apply(*refused);
        memory.failAt = memory.calls;
        EXPECT_EQ(walr_prepare(hosted.denoiser()), WALR_ERROR_OUT_OF_MEMORY);
        EXPECT_EQ(memory.live, before);
        memory.failAt = memory.calls;
        apply({kSize, "packed"});  // Needs no more memory.
      }
      const FrameDescription camera = cameraAt({}, {}, kSize, i);
      hosted.fill(renderFrame(sphere(), camera, kSize));
      result = hosted.frame(camera);
    }
    return result;
  };
  const std::vector<std::uint16_t> expected = run(std::nullopt);
  EXPECT_EQ(run(Change{2 * kSize, "packed"}), expected);
  EXPECT_EQ(run(Change{kSize, "half"}), expected);
}

TEST_F(CApiMemory, ThatIsNotAsRequestedIsAnErrorAndFreed) {
  Suballocator memory(context());
  const WalrMemoryCallbacks callbacks = memory.callbacks();
  HostedRun run(device(), "walr", kSize, {.deviceMemory = &callbacks});
  memory.misplaced = 1;
  EXPECT_EQ(walr_prepare(run.denoiser()), WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_NE(std::string(walr_last_error()).find("offset is no multiple"), std::string::npos) << walr_last_error();
  EXPECT_EQ(memory.live, 0U);
  memory.misplaced = 0;
  memory.mapsNothing = true;
  EXPECT_EQ(walr_prepare(run.denoiser()), WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_NE(std::string(walr_last_error()).find("mapped is null"), std::string::npos) << walr_last_error();
  EXPECT_EQ(memory.live, 0U);
}

TEST_F(CApiMemory, WithoutACallbackIsAnError) {
  Suballocator memory(context());
  WalrDevice host = hostDevice(device());
  for (const bool allocates : {false, true}) {
    WalrMemoryCallbacks callbacks = memory.callbacks();
    if (allocates) {
      callbacks.free = nullptr;
    } else {
      callbacks.allocate = nullptr;
    }
    host.device_memory = &callbacks;
    EXPECT_EQ(walr_check_device(&host), WALR_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(std::string(walr_last_error()),
              std::string("WalrMemoryCallbacks::") + (allocates ? "free" : "allocate") + " is null");
  }
  WalrMemoryCallbacks callbacks = memory.callbacks();
  callbacks.struct_size = 0;
  host.device_memory = &callbacks;
  EXPECT_EQ(walr_check_device(&host), WALR_ERROR_STRUCT_SIZE);
  // A caller with an older header has no such field.
  host.struct_size = offsetof(WalrDevice, device_memory);
  EXPECT_EQ(walr_check_device(&host), WALR_SUCCESS);
}

TEST_F(CApiMemory, OfAnOlderHeaderIsWrittenNoFurther) {
  constexpr std::uint64_t kOwn = 0x5a5a5a5a5a5a5a5a;  // The caller's, behind its structure.
  WalrMemory known{};
  known.struct_size = offsetof(WalrMemory, shared);
  known.shared = kOwn;
  const WalrDenoiserInfo described = info("accumulate");
  require(walr_query_memory(&described, &known));
  EXPECT_GT(known.allocated, 0U);
  EXPECT_EQ(known.shared, kOwn);
}

TEST_F(CApiMemory, IsKnownBeforeItIsAllocated) {
  for (const std::string& method : denoiserNames()) {
    for (const bool lint : {false, true}) {
      // The linter and counters add passes, which change lifetimes: of a long plan and of a short one.
      if (!lint && method != "walr" && method != "accumulate") continue;
      SCOPED_TRACE(method);
      WalrDenoiserInfo described = info(method.c_str());
      described.lint = lint ? VK_TRUE : VK_FALSE;
      described.counters = described.lint;
      described.frames_in_flight = 3;
      device_.get_instance_proc_addr = countDeviceCalls(context().view.getInstanceProcAddr);
      WalrMemory known{};
      known.struct_size = sizeof(known);
      require(walr_query_memory(&described, &known));
      EXPECT_EQ(deviceCalls.bytes, 0U);
      WalrDenoiser denoiser = nullptr;
      require(walr_create_denoiser(&described, &denoiser));
      require(walr_prepare(denoiser));
      const WalrMemory allocated = memoryOf(denoiser);
      EXPECT_EQ(deviceCalls.bytes, allocated.allocated);
      EXPECT_EQ(known.allocated, allocated.allocated);
      EXPECT_EQ(known.persistent, allocated.persistent);
      EXPECT_EQ(known.transient, allocated.transient);
      EXPECT_EQ(known.transient_unaliased, allocated.transient_unaliased);
      EXPECT_EQ(known.transient_least, allocated.transient_least);
      EXPECT_EQ(known.retired, 0U);
      require(walr_destroy_denoiser(denoiser));
    }
  }
  WalrDenoiserInfo wrong = info("magic");
  WalrMemory memory{};
  memory.struct_size = sizeof(memory);
  EXPECT_EQ(walr_query_memory(&wrong, &memory), WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(walr_query_memory(nullptr, &memory), WALR_ERROR_INVALID_ARGUMENT);
}

}  // namespace
}  // namespace walr::test::memory_test
