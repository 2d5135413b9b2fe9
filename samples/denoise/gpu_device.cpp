#include "samples/denoise/gpu_device.h"

#include <stdexcept>
#include <utility>

#include "framegraph/compile/compile.h"
#include "framegraph/vulkan/driver_memory_model.h"

namespace walr {
namespace {

fg::vk::PhysicalDevice chooseDevice(const fg::vk::Instance& instance, const std::string& choice) {
  fg::vk::PhysicalDevice device = fg::vk::choose(fg::vk::physicalDevices(instance), choice);
  fg::vk::require(device);
  return device;
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
      device_(instance_, physical_, options.deviceExtensions) {}

void GpuDevice::refuseMessages() {
  const std::vector<fg::vk::Message> messages = takeMessages();
  if (!messages.empty()) {
    throw std::runtime_error("the validation layer has " + std::to_string(messages.size()) +
                             " message(s); the first: " + messages.front().text);
  }
}

fg::Plan compileFor(const GpuDevice& device, const fg::Graph& graph) {
  const fg::Plan portable = compilePlan(graph, fg::TableMemoryModel());
  fg::vk::require(device.physical(), fg::vk::formatUses(graph.desc(), portable));
  return compilePlan(graph, fg::vk::DriverMemoryModel(device.device().context()));
}

}  // namespace walr
