#pragma once

#include <cstdint>
#include <vector>

#include "host/vulkan_host.h"
#include "tests/integration/host_timeline.h"
#include "tests/integration/random_calls.h"

namespace walr::test {

/// Records frames with right and wrong images on a real device, and submits those that are accepted.
class RandomFrames final : public FrameRecorder {
 public:
  explicit RandomFrames(Host& host);
  ~RandomFrames() override;
  RandomFrames(const RandomFrames&) = delete;
  RandomFrames& operator=(const RandomFrames&) = delete;

  void record(Dice& dice, CallCheck& check, const ModelledDenoiser& denoiser) override;
  void recordPass(Dice& dice, CallCheck& check, const ModelledPasses& passes) override;
  [[nodiscard]] std::uint64_t recorded() const { return recorded_; }
  [[nodiscard]] std::uint64_t recordedPasses() const { return recordedPasses_; }

 private:
  HostImage& makeImage(VkFormat format, std::uint32_t width, std::uint32_t height, VkImageUsageFlags usage);
  WalrImage describe(Dice& dice, const HostImage& image);
  VkBuffer makeBuffer(const WalrResource& resource);
  WalrPassResource resourceFor(Dice& dice, const WalrResource& resource);
  void submit(VkCommandBuffer commands, std::uint64_t finishedValue);
  void destroyAll();

  Host* host_;
  HostTimeline timeline_;
  std::vector<HostImage> images_;
  std::vector<HostBuffer> buffers_;
  std::uint64_t lastIdentity_ = 0;
  std::uint64_t recorded_ = 0;
  std::uint64_t recordedPasses_ = 0;
};

}  // namespace walr::test
