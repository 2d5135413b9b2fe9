#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <walr/walr_passes.h>

#include "framegraph/vulkan/completions.h"
#include "integration/c_api/description.h"
#include "integration/c_api/device.h"
#include "integration/c_api/hosted_counters.h"
#include "integration/c_api/hosted_lint.h"
#include "integration/c_api/pass_list.h"
#include "integration/c_api/pass_recording.h"
#include "integration/c_api/pass_timestamps.h"

namespace walr::api {

/// The object behind a WalrPasses: the passes of a method or a single stage, for a host that schedules them itself.
class HostedPasses {
 public:
  /// @throws as `Description` does
  /// @param ports see `Description::list`
  HostedPasses(const WalrDenoiserInfo& info, std::span<const WalrSettingValue> settings,
               std::span<const WalrPortFormat> ports);

  [[nodiscard]] const WalrPassList& list() const { return list_->list(); }
  /// Continue from the last frame of other passes, which have another size or other settings.
  /// @throws Error if those have had no frame, are of another method, or are of another size without
  ///         WalrConventions::rectangle
  void continueFrom(const HostedPasses& last);
  void beginFrame(const WalrPassFrame& frame);
  /// Contents of an upload buffer.
  /// @throws Error before the first frame, and for a resource that is not an upload
  [[nodiscard]] std::span<const std::byte> frameConstants(std::uint32_t resource) const;
  void record(std::uint32_t pass, VkCommandBuffer commandBuffer, std::span<const WalrPassResource> resources);
  void forget(VkImage image, std::uint64_t identity);
  /// Times of the last evaluated frame; empty without timestamps.
  [[nodiscard]] std::span<const WalrPassTime> timings() const { return times_; }
  /// @throws Error if the passes were created without lint
  [[nodiscard]] std::span<const LintFinding> findings() const;
  /// @throws Error if nothing is counted
  [[nodiscard]] std::vector<WalrCounter> counters() const;

 private:
  /// What a pass does with a buffer of counts. One pass clears it, later ones count.
  enum class CountUse : std::uint8_t { None, Clear, Count, CountLast };

  void makeCounts();
  [[nodiscard]] const WalrBinding* bindingOf(std::uint32_t pass, fg::Buffer counts) const;
  [[nodiscard]] CountUse useOf(std::uint32_t pass, fg::Buffer counts) const;

  Description description_;
  std::unique_ptr<HostDevice> device_;  ///< Null where passes are only listed.
  ListedGraph graph_;
  fg::Plan plan_;
  std::optional<PassList> list_;
  std::optional<PassRecording> recording_;
  std::optional<fg::vk::Completions> completions_;
  std::optional<Constants> constants_;
  std::optional<std::uint64_t> lastLinted_;  ///< Number of the last frame whose inputs were checked.
  std::optional<PassTimestamps> timestamps_;
  std::vector<WalrPassTime> times_;
  std::optional<HostedLint> lint_;
  std::optional<HostedCounters> counters_;
};

}  // namespace walr::api
