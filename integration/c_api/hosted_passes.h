#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <walr/walr_passes.h>

#include "integration/c_api/description.h"
#include "integration/c_api/device.h"
#include "integration/c_api/pass_list.h"
#include "integration/c_api/pass_recording.h"

namespace walr::api {

/// A method or a single stage spelled out for a host that schedules by itself: what is behind a WalrPasses.
class HostedPasses {
 public:
  /// @throws what is wrong with the description
  /// @param ports see `Description::list`
  HostedPasses(const WalrDenoiserInfo& info, std::span<const WalrSettingValue> settings,
               std::span<const WalrPortFormat> ports);

  [[nodiscard]] const WalrPassList& list() const { return list_->list(); }
  /// Let the next frame go on from the last one of other passes: of another size, or with other settings.
  /// @throws Error where those have no frame, or are of another size that was not stated to change
  void goOnFrom(const HostedPasses& last);
  void beginFrame(const WalrPassFrame& frame);
  /// Contents of an upload buffer.
  /// @throws Error before the first frame, and for another resource
  [[nodiscard]] std::span<const std::byte> frameConstants(std::uint32_t resource) const;
  void record(std::uint32_t pass, VkCommandBuffer commandBuffer, std::span<const WalrPassResource> resources);
  void forget(VkImage image, std::uint64_t identity);

 private:
  Description description_;
  std::unique_ptr<HostDevice> device_;  ///< Null where passes are only listed.
  ListedGraph graph_;
  fg::Plan plan_;
  std::optional<PassList> list_;
  std::optional<PassRecording> recording_;
  std::optional<Constants> constants_;
};

}  // namespace walr::api
