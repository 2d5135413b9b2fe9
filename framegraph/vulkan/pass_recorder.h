#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "framegraph/vulkan/descriptors.h"
#include "framegraph/vulkan/fill.h"
#include "framegraph/vulkan/history_state.h"
#include "framegraph/vulkan/timestamps.h"

namespace fg::vk {

/// Records the passes of a plan, each with its barriers.
class PassRecorder {
 public:
  struct Options {
    bool poison = false;             ///< See `ExecutorOptions::poison`.
    bool inheritsHistories = false;  ///< Images of previous histories may change.
  };
  /// @param pipelines must outlive the recorder
  PassRecorder(const DeviceContext& device, const GraphDesc& graph, const Plan& plan, const Resources& resources,
               Views& views, Pipelines& pipelines, std::uint32_t slots, const Options& options);
  PassRecorder(const PassRecorder&) = delete;
  PassRecorder& operator=(const PassRecorder&) = delete;

  /// Take constants and pipelines from a graph of the same topology. If this throws, nothing has changed.
  void update(const GraphDesc& graph);
  /// Note that an image has changed.
  void invalidateImages() { descriptors_.invalidateImages(); }
  void record(VkCommandBuffer commandBuffer, FrameIndex frame, const HistoryStates& histories, Timestamps* timestamps);

 private:
  struct Step {
    const PassDecl* pass = nullptr;
    FillingBatch barriers;
    ComputePipeline pipeline;          ///< Null for callback passes.
    std::vector<std::byte> constants;  ///< Push constants; ages of histories are filled in.
  };
  static std::vector<Step> makeSteps(const DeviceContext& device, const GraphDesc& graph, const Plan& plan,
                                     Pipelines& pipelines, bool poison);
  static ComputePipeline makePipeline(const DeviceContext& device, const PassDecl& pass, const ComputeDispatch& work,
                                      Pipelines& pipelines);
  void requestCallbackViews(const PassDecl& pass);
  void dispatch(VkCommandBuffer commandBuffer, std::size_t index, const ComputeDispatch& work,
                const HistoryStates& histories);
  [[nodiscard]] std::vector<VkDescriptorSetLayout> setLayouts() const;

  const DeviceContext* device_;
  const Plan* plan_;
  const Resources* resources_;
  Views* views_;
  FrameIndex frame_;
  Pipelines* pipelines_;
  std::vector<Step> steps_;
  std::vector<std::uint32_t> callbackViews_;  ///< By resource: view of the whole texture, or kNone.
  Descriptors descriptors_;
  RecordContext context_;  ///< Passed to callbacks.
};

}  // namespace fg::vk
