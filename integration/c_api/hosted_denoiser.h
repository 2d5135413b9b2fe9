#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <walr/walr.h>

#include "framegraph/vulkan/completions.h"
#include "framegraph/vulkan/executor.h"
#include "integration/c_api/description.h"
#include "integration/c_api/device.h"
#include "integration/c_api/host_images.h"
#include "integration/c_api/hosted_counters.h"
#include "integration/c_api/hosted_lint.h"

namespace walr::api {

/// The object behind a WalrDenoiser: a denoiser that records into a host's command buffers.
class HostedDenoiser {
 public:
  /// @param sharedWith a denoiser of the same device whose objects it shares; null for none
  /// @throws as `Description` does; Error for another device
  explicit HostedDenoiser(const WalrDenoiserInfo& info, const HostedDenoiser* sharedWith = nullptr);

  void resize(std::uint32_t width, std::uint32_t height);
  void set(std::string_view name, std::string_view value);
  void usePreset(std::string_view name);
  [[nodiscard]] std::string setting(std::string_view name) const { return description_.setting(name); }
  void prepare();
  [[nodiscard]] WalrImageRequirements requirements(std::string_view image);
  void record(VkCommandBuffer commandBuffer, const WalrFrame& frame);
  void resetHistory() { resetRequested_ = true; }
  void forget(VkImage image, std::uint64_t identity);
  [[nodiscard]] WalrImageState releaseState(std::string_view image) const;
  [[nodiscard]] WalrMemory memory() const;
  /// What `memory` will be after `prepare`.
  [[nodiscard]] WalrMemory requiredMemory();
  /// Times of the last evaluated frame; empty without timestamps.
  [[nodiscard]] std::span<const fg::vk::PassTime> timings() const;
  [[nodiscard]] std::span<const LintFinding> findings() const;
  [[nodiscard]] std::vector<ViewInfo> views() const { return description_.views(); }
  /// @throws std::invalid_argument naming a view that does not exist, and the known ones
  void setView(std::optional<std::string> name);
  /// @throws Error if nothing is counted
  [[nodiscard]] std::vector<WalrCounter> counters() const;

 private:
  /// The graph for given settings and size, with its plan. It needs no Vulkan object.
  struct Declared {
    DenoiseGraph graph;
    fg::Plan plan;
    std::array<fg::Texture, kImageCount> images;
    std::array<ImageNeeds, kImageCount> needs;
  };
  /// The Vulkan objects for a `Declared`.
  struct Built {
    std::shared_ptr<Declared> declared;
    std::unique_ptr<fg::vk::Executor> executor;
    std::unique_ptr<HostedCounters> counters;  ///< Null without counters.
    std::shared_ptr<HostedLint> lint;          ///< Null without lint; shared among executors if the history is kept.
    fg::MemoryReport memory;
    fg::Extent extent;
    bool inherits = false;  ///< Its first frame reads the histories of the `Built` that was retired last.
    std::optional<std::uint64_t> lastFrame;   ///< Number of the last frame that uses it.
    std::span<const fg::vk::PassTime> times;  ///< Of the last evaluated frame; the executor's.

    [[nodiscard]] std::uint64_t allocatedBytes(bool withLint = true) const;
  };

  /// The graph for the current settings and size. If only constants differ from the last one, its plan is kept.
  const Declared& declare();
  [[nodiscard]] DenoiseGraph declareGraph(const std::optional<std::string>& view) const;
  Declared compile(DenoiseGraph graph) const;
  void build();
  void makeExecutor();
  Built* predecessor();
  void dropFinished();
  [[nodiscard]] FrameImages checkedImages(const WalrFrame& frame) const;
  void bind(const FrameImages& images);
  void evaluateFinishedFrame();
  void recordGraph(VkCommandBuffer commandBuffer, const FrameDescription& camera, bool reset);
  void uploadIfUsed(fg::Buffer buffer, std::span<const std::byte> bytes);
  void log(WalrLogLevel level, const std::string& text) const;

  /// The device and what several denoisers share on it.
  struct Shared {
    Shared(const WalrDevice* given, VkPipelineCache cache) : device(given), objects(device.context(), cache) {}
    HostDevice device;
    fg::vk::SharedObjects objects;
  };
  static std::shared_ptr<Shared> sharedObjects(const WalrDenoiserInfo& info, const HostedDenoiser* sharedWith);
  [[nodiscard]] const HostDevice& device() const { return shared_->device; }

  std::shared_ptr<Shared> shared_;
  std::uint32_t member_;  ///< In `Shared::objects`.
  Description description_;
  fg::vk::Completions completions_;
  bool timestamps_;
  bool lint_;
  bool counters_;
  WalrLog log_;
  void* logUser_;

  std::optional<std::string> view_;     ///< Written to the host's image.
  std::shared_ptr<Declared> declared_;  ///< The latest.
  bool stale_ = true;                   ///< Settings or size may have changed since.
  bool updates_ = false;                ///< The executor does not have the constants of `declared_` yet.
  std::optional<Built> built_;          ///< What the last frame used, or the next one will.
  std::vector<Built> retired_;          ///< In use by frames in flight; the oldest first.
  bool resetRequested_ = false;
  FrameImages lastImages_{};
};

}  // namespace walr::api
