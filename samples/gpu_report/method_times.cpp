#include "samples/gpu_report/method_times.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "framegraph/vulkan/error.h"
#include "samples/bench/plan_costs.h"
#include "samples/bench/variant_estimate.h"
#include "samples/estimate/frame_estimate.h"
#include "samples/gpu_report/machine_memory.h"

namespace walr {
namespace {

std::vector<PassModel> modelsOf(const Variant& variant, const TimedContent& content,
                                const std::optional<ModelMachines>& machines) {
  const auto estimatesOn = [&](const Machine& machine) {
    return estimatePasses(variant, content.extent, shaderFigures(), machine, content.layout->conventions);
  };
  const Machine& machine = machines ? machines->peak : machineNamed(kDefaultMachine);
  const auto peak = estimatesOn(machine);
  std::vector<PassModel> models;
  models.reserve(peak.size());
  for (const PassEstimate& pass : peak) {
    models.push_back({.batch = pass.batch, .bytes = static_cast<double>(pass.bytes), .peak = {}, .attainable = {}});
  }
  if (!machines) return models;
  const auto attainable = estimatesOn(machines->attainable);
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

std::string whyTooLarge(const MemoryNeeded& needed, const MemoryThere& there) {
  const auto mebibytes = [](double bytes) { return std::to_string(std::llround(bytes / (1U << 20U))) + " MiB"; };
  if (needed.device > there.device) {
    return "needs " + mebibytes(needed.device) + " of device memory, and the device has " + mebibytes(there.device);
  }
  if (!there.machine) return {};
  const std::string free = mebibytes(*there.machine) + " are free";
  if (there.shared && needed.machine + needed.device > *there.machine) {
    return "needs " + mebibytes(needed.device) + " of device memory and " + mebibytes(needed.machine) +
           " beside it, both of the machine's memory, of which " + free;
  }
  const double alone = std::max(needed.making, needed.machine);
  return alone <= *there.machine ? "" : "needs " + mebibytes(alone) + " of the machine's memory, of which " + free;
}

std::string whyTooLarge(const GpuDevice& device, const Variant& variant, fg::Extent extent, bool framesMade) {
  // Lighting, normal, motion and albedo of 8 bytes, depth of 4; the result has 8.
  constexpr double kBytesOfFrame = 36.0;
  constexpr double kBytesOfResult = 8.0;
  // What the making of traced frames takes at its peak, which is more than that of synthetic ones: from 1024 x 1024 to
  // 2048 x 2048 pixels, the memory of a report on lavapipe grows by 235 bytes a pixel.
  constexpr double kBytesOfMaking = 240.0;
  const PlanCosts costs = planCosts(variant, extent, InputConventions{});
  const double pixels = static_cast<double>(extent.width) * extent.height;
  MemoryNeeded needed;
  needed.device = pixels * (kBytesOfFrame * kTimedFrames + kBytesOfResult) +
                  static_cast<double>(costs.persistentBytes) + static_cast<double>(costs.transientPeakBytes);
  needed.machine = pixels * kBytesOfFrame * kTimedFrames * (framesMade ? 1.0 : 2.0);
  needed.making = framesMade ? 0.0 : pixels * kBytesOfMaking;

  MemoryThere there;
  const fg::vk::DeviceContext& context = device.device().context();
  for (std::uint32_t i = 0; i < context.memory.memoryHeapCount; ++i) {
    const bool own = (context.memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0;
    if (own) there.device = std::max(there.device, static_cast<double>(context.memory.memoryHeaps[i].size));
  }
  const VkPhysicalDeviceType type = device.physical().type;
  there.shared = type == VK_PHYSICAL_DEVICE_TYPE_CPU || type == VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU;
  if (const std::optional<std::uint64_t> machine = freeMachineMemory()) there.machine = static_cast<double>(*machine);
  return whyTooLarge(needed, there);
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
    result.whyNot = whyTooLarge(device, variant, content.extent, true);
    if (!result.whyNot.empty()) return result;
    FrameLoop loop(device, variant, content);
    result.warmUpFrames = loop.run(effort.warmUp, nullptr);
    FrameTimes times;
    loop.run(effort.timed, &times);
    result.timing = times.timing();
    result.models = modelsOf(variant, content, machines);
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
