#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "framegraph/declare/graph.h"
#include "framegraph/plan/plan.h"
#include "framegraph/vulkan/device.h"
#include "framegraph/vulkan/instance.h"
#include "framegraph/vulkan/messages.h"
#include "framegraph/vulkan/physical_device.h"
#include "framegraph/vulkan/pipelines.h"

namespace walr {

/// A Vulkan device chosen by the user, with its own Vulkan instance.
class GpuDevice {
 public:
  struct Options {
    std::string device;       ///< Number or part of the name; empty: the most capable device.
    bool validation = false;  ///< Run under the Khronos validation layer with synchronization validation.
    std::vector<const char*> instanceExtensions = {};  ///< Further ones to enable, for instance for windows.
    std::vector<const char*> deviceExtensions = {};
    bool rayQueries = false;     ///< Enable ray queries if the device has what `missingForRayQueries` asks for.
    bool keepPipelines = false;  ///< Store compiled pipelines in a file, see `pipelineCacheFile`.
  };

  /// @throws fg::vk::Error if there is no device, or none that meets the requirements
  explicit GpuDevice(const Options& options);
  /// Stores newly compiled pipelines, if requested. Errors are ignored: without the file, the next start is only
  /// slower.
  ~GpuDevice();
  GpuDevice(const GpuDevice&) = delete;
  GpuDevice& operator=(const GpuDevice&) = delete;

  [[nodiscard]] const std::string& name() const { return physical_.name; }
  /// Driver and its version.
  [[nodiscard]] const std::string& driver() const { return physical_.driver; }
  /// Whether the device is a CPU implementation of Vulkan.
  [[nodiscard]] bool isSoftware() const { return physical_.type == VK_PHYSICAL_DEVICE_TYPE_CPU; }

  [[nodiscard]] const fg::vk::PhysicalDevice& physical() const { return physical_; }
  [[nodiscard]] const fg::vk::Device& device() const { return device_; }
  [[nodiscard]] const fg::vk::InstanceFunctions& functions() const { return instance_.functions(); }
  [[nodiscard]] VkInstance instance() const { return instance_.handle(); }
  /// The cache of compiled pipelines that is stored; null unless pipelines are stored.
  [[nodiscard]] fg::vk::PipelineCache* pipelineCache() const { return pipelineCache_.get(); }
  /// The pipelines of all graphs on this device, so that a method that comes again is there at once.
  [[nodiscard]] const std::shared_ptr<fg::vk::Pipelines>& pipelines() const { return pipelines_; }

  /// What the device lacks for ray queries; empty if they are enabled.
  [[nodiscard]] const std::string& missingForRayQueries() const { return missingForRayQueries_; }

  /// Messages of the validation layer since the last call.
  std::vector<fg::vk::Message> takeMessages() { return log_.take(); }
  /// @throws std::runtime_error with the first message of the validation layer, if there is one
  void refuseMessages();

 private:
  fg::vk::MessageLog log_;
  fg::vk::Instance instance_;
  fg::vk::PhysicalDevice physical_;
  std::string missingForRayQueries_;
  fg::vk::Device device_;
  std::unique_ptr<fg::vk::PipelineCache> pipelineCache_;
  std::shared_ptr<fg::vk::Pipelines> pipelines_;
};

/// @throws std::runtime_error with the first of the validation layer's messages, if there is one
void refuseMessages(const std::vector<fg::vk::Message>& messages);

/// The file with a device's compiled pipelines. It lies in `$XDG_CACHE_HOME/walr`, or else in `~/.cache/walr` (XDG Base
/// Directory Specification), and its name contains the device's pipeline cache UUID and the driver's version. Empty if
/// neither variable is set to an absolute path.
std::filesystem::path pipelineCacheFile(const fg::vk::DeviceContext& device);

/// Check that the device supports all uses of formats, then compile the graph for it.
/// @throws std::runtime_error with all errors of the graph; fg::vk::Error naming the format uses that the device lacks
fg::Plan compileFor(const GpuDevice& device, const fg::Graph& graph);

}  // namespace walr
