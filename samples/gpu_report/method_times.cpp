#include "samples/gpu_report/method_times.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "framegraph/vulkan/error.h"
#include "samples/bench/plan_costs.h"
#include "samples/bench/variant_estimate.h"
#include "samples/estimate/frame_estimate.h"

namespace walr {
namespace {

std::vector<PassModel> modelsOf(const Variant& variant, fg::Extent extent,
                                const std::optional<ModelMachines>& machines) {
  const Machine& machine = machines ? machines->peak : machineNamed(kDefaultMachine);
  const auto peak = estimatePasses(variant, extent, shaderFigures(), machine);
  std::vector<PassModel> models;
  models.reserve(peak.size());
  for (const PassEstimate& pass : peak) {
    models.push_back({.batch = pass.batch, .bytes = static_cast<double>(pass.bytes), .peak = {}, .attainable = {}});
  }
  if (!machines) return models;
  const auto attainable = estimatePasses(variant, extent, shaderFigures(), machines->attainable);
  for (std::size_t i = 0; i < models.size(); ++i) {
    models[i].peak = peak[i].bounds;
    models[i].attainable = attainable[i].bounds;
  }
  return models;
}

}  // namespace

std::optional<double> MethodTimes::estimatedMicroseconds() const {
  if (models.empty()) return std::nullopt;
  FrameEstimate estimate;
  for (const PassModel& model : models) estimate.add(model.batch, model.peak);
  return estimate.microseconds();
}

bool MethodTimes::unsteady() const {
  return timing.milliseconds && timing.milliseconds->p95 > kSteady * timing.milliseconds->median;
}

std::string whyTooLarge(const GpuDevice& device, const Variant& variant, fg::Extent extent) {
  // Lighting, normal, motion and albedo of 8 bytes, depth of 4; the result has 8.
  constexpr double kBytesOfFrame = 36.0;
  constexpr double kBytesOfResult = 8.0;
  constexpr double kMebi = 1.0 / (1U << 20U);
  const PlanCosts costs = planCosts(variant, extent, InputConventions{});
  const double pixels = static_cast<double>(extent.width) * extent.height;
  const double needed = pixels * (kBytesOfFrame * kTimedFrames + kBytesOfResult) +
                        static_cast<double>(costs.persistentBytes) + static_cast<double>(costs.transientPeakBytes);
  double largest = 0.0;
  const VkPhysicalDeviceMemoryProperties& memory = device.device().context().memory;
  for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
    const bool own = (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0;
    if (own) largest = std::max(largest, static_cast<double>(memory.memoryHeaps[i].size));
  }
  if (needed <= largest) return {};
  return "needs " + std::to_string(std::llround(needed * kMebi)) + " MiB of device memory, and the device has " +
         std::to_string(std::llround(largest * kMebi)) + " MiB";
}

MethodTimes timeMethod(const GpuDevice& device, const Variant& variant, const TimedContent& content,
                       const std::optional<ModelMachines>& machines, const TimingEffort& effort) {
  MethodTimes result;
  result.variant = variant.name;
  if (device.device().context().timestampBits == 0) {
    result.whyNot = "the device's queue has no timestamps";
    return result;
  }
  try {
    result.whyNot = whyTooLarge(device, variant, content.extent);
    if (!result.whyNot.empty()) return result;
    FrameLoop loop(device, variant, content);
    result.warmUpFrames = loop.run(effort.warmUp, nullptr);
    FrameTimes times;
    loop.run(effort.timed, &times);
    result.timing = times.timing();
    result.models = modelsOf(variant, content.extent, machines);
  } catch (const fg::vk::DeviceLost&) {
    throw;
  } catch (const std::invalid_argument& error) {
    result.whyNot = error.what();
  } catch (const fg::vk::Error& error) {
    result.whyNot = error.what();
  }
  return result;
}

}  // namespace walr
