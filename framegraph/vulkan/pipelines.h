#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "framegraph/declare/graph.h"
#include "framegraph/vulkan/owned.h"

namespace fg::vk {

/// A VkPipelineCache that may be kept in a file, so that the next start compiles nothing. Share one among executors.
class PipelineCache {
 public:
  /// @param file where to load from and save to; empty for none. A file that is not there, is damaged, or is another
  ///        device's or driver's counts as empty.
  explicit PipelineCache(const DeviceContext& device, std::filesystem::path file = {});

  [[nodiscard]] VkPipelineCache handle() const { return cache_.get(); }
  /// Bytes that the file contributed; 0 where it did not count.
  [[nodiscard]] std::size_t loadedBytes() const { return loaded_.size(); }
  /// Write the file if anything was added, by way of a temporary name so that it is never half written.
  /// @throws std::filesystem::filesystem_error naming a file that cannot be written
  void save();

 private:
  const DeviceContext* device_;
  std::filesystem::path file_;
  std::vector<char> loaded_;
  Owned<VkPipelineCache> cache_;
};

/// What is bound to run a shader.
struct ComputePipeline {
  VkPipeline pipeline = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
};

/// Pipelines of a graph: one per shader and specialization, layouts one per shader.
class Pipelines {
 public:
  Pipelines(const DeviceContext& device, VkPipelineCache cache) : device_(&device), cache_(cache) {}

  /// @throws PipelineFailed naming the shader, or OutOfMemory
  ComputePipeline get(const Shader& shader, const std::vector<std::uint32_t>& specialization);

 private:
  struct Layouts {
    Owned<VkDescriptorSetLayout> set;
    Owned<VkPipelineLayout> pipeline;
  };
  const Layouts& layouts(const Shader& shader);
  Owned<VkPipeline> makePipeline(const Shader& shader, const std::vector<std::uint32_t>& specialization,
                                 VkPipelineLayout layout);

  const DeviceContext* device_;
  VkPipelineCache cache_;
  std::map<const Shader*, Layouts> layouts_;
  std::map<std::pair<const Shader*, std::vector<std::uint32_t>>, Owned<VkPipeline>> pipelines_;
};

}  // namespace fg::vk
