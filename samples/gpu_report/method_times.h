#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "samples/bench/timing.h"
#include "samples/bench/variant.h"
#include "samples/denoise/gpu_device.h"
#include "samples/estimate/machine.h"
#include "samples/gpu_report/frame_loop.h"
#include "samples/gpu_report/timed_content.h"

namespace walr {

/// What the static model says of a pass: estimates, and no measurements.
struct PassModel {
  std::uint32_t batch = 0;
  double bytes = 0.0;                ///< Of the plan.
  std::optional<Bounds> peak;        ///< At the machine's peak rates.
  std::optional<Bounds> attainable;  ///< The same with the measured rates of memory and of cached fetches.
};

/// Times are unsteady if their 95 % quantile is more than this many times the median.
constexpr double kSteady = 1.5;

/// Times of one method on one content.
struct MethodTimes {
  std::string variant;
  std::size_t warmUpFrames = 0;
  Timing timing;                  ///< Without ratios.
  std::vector<PassModel> models;  ///< One per pass of `timing`.
  std::string whyNot;             ///< Why there are no times; empty if there are.

  /// Estimate of a frame at peak rates (`FrameEstimate`) in microseconds; nothing if a pass has none.
  [[nodiscard]] std::optional<double> estimatedMicroseconds() const;
  /// Whether the times are unsteady (`kSteady`): clock rates changed meanwhile, or another program used the device. On
  /// an H100 without other work, methods that had warmed up stayed within 1.05 times the median.
  [[nodiscard]] bool unsteady() const;
};

/// Times of all methods on one content.
struct ContentMethodTimes {
  std::string content;
  std::string description;
  fg::Extent extent;
  std::vector<MethodTimes> methods;
};

/// The machine of the estimates, with its peak rates and with those that were measured.
struct ModelMachines {
  Machine peak;
  Machine attainable;
};

/// How long each method warms up and is timed.
struct TimingEffort {
  LoopLength warmUp;
  LoopLength timed;
};

/// What a method with its input frames takes, in bytes.
struct MemoryNeeded {
  double making = 0.0;   ///< Of the machine's memory, before, to make the frames.
  double machine = 0.0;  ///< Of the machine's memory: the frames and the buffers from which they are uploaded.
  double device = 0.0;   ///< Of the device's memory.
};

/// What there is, in bytes.
struct MemoryThere {
  double device = 0.0;            ///< The largest heap of the device's own memory.
  bool shared = false;            ///< The device's memory is the machine's, as that of software and integrated devices.
  std::optional<double> machine;  ///< What is free of the machine's memory, if known.
};

/// @returns an empty text, or what does not fit
std::string whyTooLarge(const MemoryNeeded& needed, const MemoryThere& there);

/// Whether a method with its input frames fits into memory, by the plan's sizes.
/// @param framesMade whether the frames lie in memory already
/// @returns an empty text, or what does not fit
/// @throws std::invalid_argument naming a setting of the method that does not support the size
std::string whyTooLarge(const GpuDevice& device, const Variant& variant, fg::Extent extent, bool framesMade);

/// Time a method. What keeps it from running, such as a size that does not fit into memory, is reported in `whyNot`.
/// @param machines nothing: no estimates
/// @throws fg::vk::DeviceLost
MethodTimes timeMethod(const GpuDevice& device, const Variant& variant, const TimedContent& content,
                       const std::optional<ModelMachines>& machines, const TimingEffort& effort);

}  // namespace walr
