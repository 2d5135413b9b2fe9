#pragma once

#include <cstdint>
#include <vector>

#include "host/vulkan_host.h"
#include "tests/integration/random_calls.h"

namespace walr::test {

/// Records frames with right and wrong images on a real device, and submits those that are accepted.
class RandomFrames final : public FrameRecorder {
 public:
  explicit RandomFrames(Host& host) : host_(&host) {}
  ~RandomFrames() override;
  RandomFrames(const RandomFrames&) = delete;
  RandomFrames& operator=(const RandomFrames&) = delete;

  void record(Dice& dice, CallCheck& check, const ModelledDenoiser& denoiser) override;
  [[nodiscard]] std::uint64_t recorded() const { return recorded_; }

 private:
  WalrImage makeImage(const WalrImageRequirements& needs);

  Host* host_;
  std::vector<HostImage> images_;
  std::uint64_t lastIdentity_ = 0;
  std::uint64_t recorded_ = 0;
};

}  // namespace walr::test
