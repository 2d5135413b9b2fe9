#include "samples/denoise/gpu_device.h"

namespace walr {
namespace {

fg::vk::PhysicalDevice chooseDevice(const fg::vk::Instance& instance, const std::string& choice) {
  fg::vk::PhysicalDevice device = fg::vk::choose(fg::vk::physicalDevices(instance), choice);
  fg::vk::require(device);
  return device;
}

}  // namespace

GpuDevice::GpuDevice(const Options& options)
    : instance_({.validation = options.validation, .sink = log_.sink()}),
      physical_(chooseDevice(instance_, options.device)),
      device_(instance_, physical_) {}

}  // namespace walr
