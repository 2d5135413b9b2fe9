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

/// A Vulkan device chosen by the user, of a Vulkan instance of its own.
class GpuDevice {
 public:
  struct Options {
    std::string device;       ///< Number or part of a name; empty for the most capable one.
    bool validation = false;  ///< Run under the Khronos validation layer with synchronization validation.
    std::vector<const char*> instanceExtensions = {};  ///< Enabled besides, for instance for windows.
    std::vector<const char*> deviceExtensions = {};
    bool keepPipelines = false;  ///< Keep compiled pipelines from run to run, see `pipelineCacheFile`.
  };

  /// @throws fg::vk::Error where there is no device, or none that will do
  explicit GpuDevice(const Options& options);
  /// Writes the pipelines that were added, if they are kept. A file that cannot be written only costs the next start
  /// time, and is passed over.
  ~GpuDevice();
  GpuDevice(const GpuDevice&) = delete;
  GpuDevice& operator=(const GpuDevice&) = delete;

  [[nodiscard]] const std::string& name() const { return physical_.name; }
  /// Driver and its version.
  [[nodiscard]] const std::string& driver() const { return physical_.driver; }
  /// Whether the device is a processor that plays a GPU.
  [[nodiscard]] bool isSoftware() const { return physical_.type == VK_PHYSICAL_DEVICE_TYPE_CPU; }

  [[nodiscard]] const fg::vk::PhysicalDevice& physical() const { return physical_; }
  [[nodiscard]] const fg::vk::Device& device() const { return device_; }
  [[nodiscard]] VkInstance instance() const { return instance_.handle(); }
  /// Where executors take compiled pipelines from and leave new ones; null unless they are kept.
  [[nodiscard]] fg::vk::PipelineCache* pipelineCache() const { return pipelineCache_.get(); }

  /// What the validation layer said since the last call.
  std::vector<fg::vk::Message> takeMessages() { return log_.take(); }
  /// @throws std::runtime_error with the first thing that the validation layer said, if it said anything
  void refuseMessages();

 private:
  fg::vk::MessageLog log_;
  fg::vk::Instance instance_;
  fg::vk::PhysicalDevice physical_;
  fg::vk::Device device_;
  std::unique_ptr<fg::vk::PipelineCache> pipelineCache_;
};

/// The file that holds a device's compiled pipelines: in `$XDG_CACHE_HOME/walr`, else `~/.cache/walr` (XDG Base
/// Directory Specification), with the device's pipeline cache UUID and the driver's version in its name. Empty where
/// the user has no such folder.
std::filesystem::path pipelineCacheFile(const fg::vk::DeviceContext& device);

/// Compile a graph for a device, after a check that names every format use that the device lacks.
/// @throws std::runtime_error with all that is wrong with the graph; fg::vk::Error for what the device lacks
fg::Plan compileFor(const GpuDevice& device, const fg::Graph& graph);

}  // namespace walr
