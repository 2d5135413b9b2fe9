#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "framegraph/declare/graph.h"
#include "framegraph/vulkan/owned.h"

namespace fg::vk {

/// A VkPipelineCache that can be saved to a file, so that the next start compiles nothing. Executors can share one.
class PipelineCache {
 public:
  /// @param file file to load and save; empty for none. A file that is missing, damaged, or from another device or
  ///        driver is ignored.
  /// @throws OutOfMemory, DeviceLost or Error if the driver cannot make it
  explicit PipelineCache(const DeviceContext& device, std::filesystem::path file = {});

  [[nodiscard]] VkPipelineCache handle() const { return cache_.get(); }
  /// Bytes that were loaded from the file; 0 if it was ignored.
  [[nodiscard]] std::size_t loadedBytes() const { return loaded_.size(); }
  /// Write the file if anything was added. It is first written under a temporary name, so that it is never incomplete.
  /// @throws std::filesystem::filesystem_error naming a file that cannot be written
  void save();

 private:
  const DeviceContext* device_;
  std::filesystem::path file_;
  std::vector<char> loaded_;
  Owned<VkPipelineCache> cache_;
};

/// A pipeline and its layouts.
struct ComputePipeline {
  VkPipeline pipeline = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
};

/// Creates and keeps pipelines, one per shader and specialization, and layouts, one per shader.
class Pipelines {
 public:
  Pipelines(const DeviceContext& device, VkPipelineCache cache) : device_(&device), cache_(cache) {}

  /// @param declared taken in halves where there are such, and the device has shaderFloat16
  /// @throws PipelineFailed naming the shader, or OutOfMemory
  ComputePipeline get(const Shader& declared, const std::vector<std::uint32_t>& specialization);
  /// Use other SPIR-V for a shader from now on. `Shader::inHalves` of a declared shader is one of its own. Pipelines of
  /// the old code live as long as this, because frames in flight may use them.
  /// @param code with the shader's bindings, constants and work group size
  /// @throws as `get` does, and nothing has changed
  void replaceCode(const Shader& shader, std::vector<std::uint32_t> code);

 private:
  struct Layouts {
    Owned<VkDescriptorSetLayout> set;
    Owned<VkPipelineLayout> pipeline;
  };
  const Layouts& layouts(const Shader& shader);
  Owned<VkPipeline> makePipeline(const Shader& shader, std::span<const std::uint32_t> code,
                                 const std::vector<std::uint32_t>& specialization, VkPipelineLayout layout);

  const DeviceContext* device_;
  VkPipelineCache cache_;
  std::map<const Shader*, std::vector<std::uint32_t>> replacedCode_;
  std::map<const Shader*, Layouts> layouts_;
  std::map<std::pair<const Shader*, std::vector<std::uint32_t>>, Owned<VkPipeline>> pipelines_;
  std::vector<Owned<VkPipeline>> oldPipelines_;  ///< Of replaced code.
};

}  // namespace fg::vk
