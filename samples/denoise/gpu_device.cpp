#include "samples/denoise/gpu_device.h"

#include <cstdint>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "framegraph/compile/compile.h"
#include "framegraph/vulkan/driver_memory_model.h"
#include "samples/denoise/ray_queries.h"

namespace walr {
namespace {

fg::vk::PhysicalDevice chooseDevice(const fg::vk::Instance& instance, const std::string& choice) {
  fg::vk::PhysicalDevice device = fg::vk::choose(fg::vk::physicalDevices(instance), choice);
  fg::vk::require(device);
  return device;
}

std::string missingFor(const fg::vk::Instance& instance, const fg::vk::PhysicalDevice& device, bool rayQueries) {
  return rayQueries ? walr::missingForRayQueries(instance.functions(), device)
                    : "the option GpuDevice::Options::rayQueries";
}

std::vector<const char*> extensionsFor(std::vector<const char*> extensions, bool rayQueries) {
  if (rayQueries) extensions.insert(extensions.end(), kRayQueryExtensions.begin(), kRayQueryExtensions.end());
  return extensions;
}

fg::Plan compilePlan(const fg::Graph& graph, const fg::MemoryModel& memory) {
  fg::CompileResult result = fg::compile(graph.desc(), memory);
  if (!result.ok()) {
    throw std::runtime_error("the frame graph does not compile:\n" + result.text());
  }
  return std::move(result.plan);
}

}  // namespace

GpuDevice::GpuDevice(const Options& options)
    : instance_({.validation = options.validation, .sink = log_.sink(), .extensions = options.instanceExtensions}),
      physical_(chooseDevice(instance_, options.device)),
      missingForRayQueries_(missingFor(instance_, physical_, options.rayQueries)),
      device_(instance_, physical_, extensionsFor(options.deviceExtensions, missingForRayQueries_.empty()),
              missingForRayQueries_.empty() ? RayQueryFeatures().chain() : nullptr) {
  if (options.keepPipelines) {
    const std::filesystem::path file = pipelineCacheFile(device_.context());
    std::error_code ignored;  // Without the folder, saving fails, which the destructor ignores.
    if (!file.empty()) std::filesystem::create_directories(file.parent_path(), ignored);
    pipelineCache_ = std::make_unique<fg::vk::PipelineCache>(device_.context(), file);
  }
  const VkPipelineCache cache = pipelineCache_ != nullptr ? pipelineCache_->handle() : VK_NULL_HANDLE;
  pipelines_ = std::make_shared<fg::vk::Pipelines>(device_.context(), cache);
}

GpuDevice::~GpuDevice() {
  if (pipelineCache_ == nullptr) return;
  try {
    pipelineCache_->save();
  } catch (const std::exception&) {
    // Without the file, the next start is only slower.
  }
}

void GpuDevice::refuseMessages() {
  walr::refuseMessages(takeMessages());
}

void refuseMessages(const std::vector<fg::vk::Message>& messages) {
  if (!messages.empty()) {
    throw std::runtime_error("the validation layer has " + std::to_string(messages.size()) +
                             " message(s); the first: " + messages.front().text);
  }
}

std::filesystem::path pipelineCacheFile(const fg::vk::DeviceContext& device) {
  const auto folderOf = [](const char* variable, const char* below) -> std::filesystem::path {
    const char* const value = std::getenv(variable);
    // The specification requires that relative paths are ignored.
    if (value == nullptr || !std::filesystem::path(value).is_absolute()) return {};
    return std::filesystem::path(value) / below;
  };
  std::filesystem::path folder = folderOf("XDG_CACHE_HOME", "walr");
  if (folder.empty()) folder = folderOf("HOME", ".cache/walr");
  if (folder.empty()) return {};
  std::ostringstream name;
  name << "pipelines-" << std::hex << std::setfill('0');
  for (const std::uint8_t byte : device.properties.pipelineCacheUUID) name << std::setw(2) << unsigned{byte};
  name << '-' << device.properties.driverVersion << ".bin";
  return folder / name.str();
}

fg::Plan compileFor(const GpuDevice& device, const fg::Graph& graph) {
  const fg::Plan portable = compilePlan(graph, fg::TableMemoryModel());
  fg::vk::require(device.physical(), fg::vk::formatUses(graph.desc(), portable));
  return compilePlan(graph, fg::vk::DriverMemoryModel(device.device().context()));
}

}  // namespace walr
