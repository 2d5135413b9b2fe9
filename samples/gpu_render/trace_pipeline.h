#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "framegraph/declare/shader.h"
#include "framegraph/vulkan/owned.h"
#include "samples/gpu_render/ray_functions.h"

namespace walr::gpu_render {

/// A compute pipeline whose descriptors are pushed while it is recorded.
class TracePipeline {
 public:
  /// @param device, functions  must outlive this
  TracePipeline(const fg::vk::DeviceContext& device, const RayFunctions& functions, const fg::Shader& shader);

  /// The descriptors of one dispatch, by the names of the shader's bindings.
  class Bindings {
   public:
    explicit Bindings(const TracePipeline& pipeline) : pipeline_(&pipeline) {}
    Bindings& buffer(std::string_view binding, VkBuffer buffer);
    Bindings& image(std::string_view binding, VkImageView view);
    Bindings& structure(std::string_view binding, VkAccelerationStructureKHR structure);

   private:
    friend class TracePipeline;
    struct Descriptor {
      const fg::ShaderBinding* binding = nullptr;
      VkDescriptorBufferInfo buffer{};
      VkDescriptorImageInfo image{};
      VkAccelerationStructureKHR structure = VK_NULL_HANDLE;
    };
    Descriptor& add(std::string_view binding);

    const TracePipeline* pipeline_;
    std::vector<Descriptor> descriptors_;
  };

  /// Record a dispatch that covers `width` x `height` threads.
  void dispatch(VkCommandBuffer commandBuffer, const Bindings& bindings, std::uint32_t width,
                std::uint32_t height) const;

 private:
  const fg::vk::DeviceContext* device_;
  const RayFunctions* functions_;
  const fg::Shader* shader_;
  fg::vk::Owned<VkDescriptorSetLayout> set_;
  fg::vk::Owned<VkPipelineLayout> layout_;
  fg::vk::Owned<VkPipeline> pipeline_;
};

}  // namespace walr::gpu_render
