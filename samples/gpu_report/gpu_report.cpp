#include "samples/gpu_report/gpu_report.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <new>
#include <sstream>
#include <stdexcept>

#include "framegraph/vulkan/error.h"
#include "framegraph/vulkan/physical_device.h"
#include "samples/bench/response_scene.h"
#include "samples/image/file_output.h"

namespace walr {
namespace {

using Clock = std::chrono::steady_clock;

/// How much is done. The quick one only shows that everything runs.
struct Effort {
  TimingEffort timing;
  LoopLength warmUpAfterPause;  ///< Of the first method after frames were made, while the GPU had nothing to do.
  std::uint32_t probeSide;      ///< Of `measureBandwidth`.
  std::size_t probeRepetitions;
  fg::Extent comparedExtent;
  int comparedFrames;
  std::uint32_t truthSamples;  ///< Per pixel, of the traced truth.
};

// A quarter of a second brings the clocks up, except after a pause of seconds. Slow methods stop after a second.
constexpr Effort kWhole{.timing = {.warmUp = {.least = 2, .most = 1000, .seconds = 0.25},
                                   .timed = {.least = 4, .most = 128, .seconds = 1.0}},
                        .warmUpAfterPause = {.least = 2, .most = 100'000, .seconds = 1.5},
                        .probeSide = 4096,
                        .probeRepetitions = 20,
                        .comparedExtent = {192, 108},
                        .comparedFrames = 8,
                        .truthSamples = 256};
constexpr Effort kQuick{
    .timing = {.warmUp = {.least = 1, .most = 1, .seconds = 0.0}, .timed = {.least = 3, .most = 3, .seconds = 0.0}},
    .warmUpAfterPause = {.least = 1, .most = 1, .seconds = 0.0},
    .probeSide = 128,
    .probeRepetitions = 2,
    .comparedExtent = {64, 36},
    .comparedFrames = 3,
    .truthSamples = 16};
constexpr int kFirstComparedFrame = 4;

std::string sizeText(fg::Extent extent) {
  return std::to_string(extent.width) + " x " + std::to_string(extent.height);
}

ReportedDevice describe(const GpuDevice& gpu) {
  const fg::vk::DeviceContext& context = gpu.device().context();
  ReportedDevice device;
  device.name = gpu.name();
  device.driver = gpu.driver();
  device.software = gpu.isSoftware();
  const std::uint32_t version = gpu.physical().apiVersion;
  device.apiVersion = std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
                      std::to_string(VK_API_VERSION_MINOR(version)) + "." +
                      std::to_string(VK_API_VERSION_PATCH(version));
  device.vendorId = context.properties.vendorID;
  device.deviceId = context.properties.deviceID;
  if (context.timestampBits > 0) device.timestampNanoseconds = context.properties.limits.timestampPeriod;
  for (std::uint32_t i = 0; i < context.memory.memoryHeapCount; ++i) {
    const VkMemoryHeap& heap = context.memory.memoryHeaps[i];
    device.heaps.push_back({heap.size, (heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0});
  }
  return device;
}

/// The machine of the estimates; nothing, and why, if the device is none of machines.json.
std::optional<ModelMachines> machinesOf(const GpuReportOptions& options, const Bandwidth& bandwidth,
                                        const std::string& device, std::string& whyNot) {
  const Machine* machine = options.machine.empty() ? machineOfDevice(device) : &machineNamed(options.machine);
  if (machine == nullptr) {
    whyNot = "'" + device + "' is no machine of samples/estimate/machines.json; --machine names one";
    return std::nullopt;
  }
  ModelMachines machines{*machine, *machine};
  machines.attainable.bytesPerSecond = bandwidth.bytesPerSecond().value_or(machine->bytesPerSecond);
  if (const BandwidthProbe* fetches = bandwidth.find(kCachedFetches); fetches != nullptr && fetches->fetchesPerSecond) {
    machines.attainable.texelsPerSecond = *fetches->fetchesPerSecond;
  }
  return machines;
}

/// Everything that the parts of a report share.
class Reporter {
 public:
  Reporter(const GpuReportOptions& options, const std::function<void(const std::string&)>& progress)
      : options_(options),
        progress_(progress),
        effort_(options.quick ? kQuick : kWhole),
        end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                std::chrono::duration<double, std::ratio<60>>(options.minutes))) {}

  GpuReport run() {
    const auto start = Clock::now();
    // A file that cannot be read must show before anything is measured.
    if (options_.sequence != nullptr) {
      static_cast<void>(given());
      static_cast<void>(sequenceContent(*options_.sequence, options_.sequenceName));
    }
    report_.build = buildInfo();
    report_.quick = options_.quick;
    progress_("validation");
    report_.validation = validate(options_.gpu, options_.variants);

    const GpuDevice device(options_.gpu);
    report_.device = describe(device);
    const ClockReader clocks(report_.device.vendorId, report_.device.deviceId, report_.device.name);
    report_.clockSource = clocks.source();
    report_.whyNoClocks = clocks.whyNot();
    readClocks(clocks, "before");
    progress_("bandwidth");
    report_.bandwidth = measureBandwidth(device, effort_.probeSide, effort_.probeRepetitions);
    readClocks(clocks, "after the bandwidth");
    report_.machines = machinesOf(options_, report_.bandwidth, report_.device.name, report_.whyNoMachine);

    BuiltInScene scene(options_.output);
    compare(device, scene);
    if (options_.sequence != nullptr) {
      timeContent(device, "sequence", options_.sequence->extent(),
                  [&] { return sequenceContent(*options_.sequence, options_.sequenceName); });
    }
    for (const fg::Extent extent : options_.sizes) {
      timeContent(device, "synthetic", extent, [&] { return syntheticContent(extent); });
      timeContent(device, "scene", extent, [&] { return scene.content(extent); });
      readClocks(clocks, "after " + sizeText(extent));
    }
    report_.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return std::move(report_);
  }

 private:
  [[nodiscard]] bool late() const { return Clock::now() > end_; }

  void readClocks(const ClockReader& reader, const std::string& when) {
    if (const std::optional<Clocks> clocks = reader.read()) report_.clocks.push_back({when, *clocks});
  }

  [[nodiscard]] std::string lateText() const {
    std::ostringstream text;
    text << "left out: the time of --minutes (" << options_.minutes << ") was over";
    return text.str();
  }

  /// Why not even the method that needs the least memory runs at a size: then the frames need not be made.
  [[nodiscard]] std::string whyNoneFits(const GpuDevice& device, fg::Extent extent) const {
    std::string whyNot;
    for (const Variant& variant : options_.variants) {
      try {
        whyNot = whyTooLarge(device, variant, extent, false);
      } catch (const std::invalid_argument& error) {
        whyNot = error.what();
      }
      if (whyNot.empty()) break;
    }
    return whyNot;
  }

  /// @param make makes the frames, unless it is late
  void timeContent(const GpuDevice& device, const std::string& name, fg::Extent extent,
                   const std::function<TimedContent()>& make) {
    progress_("times at " + sizeText(extent) + ", " + name);
    ContentMethodTimes& times = report_.times.emplace_back();
    times.content = name;
    times.extent = extent;
    std::string whyNot = late() ? lateText() : whyNoneFits(device, extent);
    std::optional<TimedContent> content;
    try {
      if (whyNot.empty()) content = make();
    } catch (const std::bad_alloc&) {
      whyNot = "the frames do not fit into the machine's memory";
    }
    if (content) times.description = content->description;
    TimingEffort effort = effort_.timing;
    effort.warmUp = effort_.warmUpAfterPause;
    for (const Variant& variant : options_.variants) {
      if (late()) whyNot = lateText();
      if (whyNot.empty()) {
        times.methods.push_back(timeMethod(device, variant, *content, report_.machines, effort));
        if (times.methods.back().timing.milliseconds) effort = effort_.timing;
      } else {
        MethodTimes& skipped = times.methods.emplace_back();
        skipped.variant = variant.name;
        skipped.whyNot = whyNot;
      }
    }
  }

  [[nodiscard]] ComparedSequence slab() const {
    ComparedSequence sequence{"synthetic", effort_.comparedExtent, &projectLayout(), {}, {}};
    for (int i = 0; i < effort_.comparedFrames; ++i) {
      KnownFrame frame = slabFrame(sequence.extent, kFirstComparedFrame + i);
      frame.packed.frame.resetHistory = i == 0;
      sequence.frames.push_back(std::move(frame.packed));
      sequence.truth = std::move(frame.truth);
    }
    return sequence;
  }

  [[nodiscard]] ComparedSequence traced(BuiltInScene& scene) const {
    ComparedSequence sequence{"scene", effort_.comparedExtent, &projectLayout(), {}, {}};
    for (int i = 0; i < effort_.comparedFrames; ++i) {
      sequence.frames.push_back(scene.frame(sequence.extent, kFirstComparedFrame + i));
      sequence.frames.back().frame.resetHistory = i == 0;
    }
    sequence.truth =
        scene.truth(sequence.extent, kFirstComparedFrame + effort_.comparedFrames - 1, effort_.truthSamples);
    return sequence;
  }

  /// The first frames of the user's sequence.
  [[nodiscard]] ComparedSequence given() const {
    const Sequence& source = *options_.sequence;
    ComparedSequence sequence{"sequence", source.extent(), &source.denoiserLayout(), {}, {}};
    const std::size_t count = std::min(source.entries().size(), static_cast<std::size_t>(effort_.comparedFrames));
    for (std::size_t i = 0; i < count; ++i) sequence.frames.push_back(packFrame(source.read(i)));
    return sequence;
  }

  /// The processor's Vulkan driver; null, and why, if there is none.
  std::unique_ptr<GpuDevice> processor() {
    const fg::vk::Instance instance;
    for (const fg::vk::PhysicalDevice& physical : fg::vk::physicalDevices(instance)) {
      if (physical.type != VK_PHYSICAL_DEVICE_TYPE_CPU) continue;
      GpuDevice::Options options = options_.gpu;
      options.device = std::to_string(physical.index);
      return std::make_unique<GpuDevice>(options);
    }
    report_.whyNoReference =
        "no Vulkan driver for processors is installed (package mesa-vulkan-drivers); --against takes the results of a "
        "report from another machine";
    return nullptr;
  }

  void compare(const GpuDevice& device, BuiltInScene& scene) {
    std::unique_ptr<GpuDevice> other;
    std::optional<ReferenceResults> reference;
    if (!options_.against.empty()) {
      reference.emplace(options_.against);
      report_.reference = "the results in " + options_.against.string();
    } else if ((other = processor()) != nullptr) {
      reference.emplace(*other);
      report_.reference = other->name() + ", driver " + other->driver();
    }
    std::vector<ComparedSequence> sequences;
    sequences.push_back(slab());
    sequences.push_back(traced(scene));
    if (options_.sequence != nullptr) sequences.push_back(given());
    for (const ComparedSequence& sequence : sequences) {
      progress_("results on the sequence '" + sequence.name + "'");
      for (const Variant& variant : options_.variants) {
        if (late()) {
          Agreement& skipped = report_.agreements.emplace_back();
          skipped.variant = variant.name;
          skipped.sequence = sequence.name;
          skipped.whyNot = lateText();
        } else {
          report_.agreements.push_back(
              compareMethod(device, variant, sequence, reference ? &*reference : nullptr, options_.output));
        }
      }
    }
  }

  const GpuReportOptions& options_;
  const std::function<void(const std::string&)>& progress_;
  Effort effort_;
  Clock::time_point end_;
  GpuReport report_;
};

}  // namespace

GpuReport gpuReport(const GpuReportOptions& options, const std::function<void(const std::string&)>& progress) {
  if (!options.machine.empty()) machineNamed(options.machine);
  prepareOutputDirectory(options.output);
  return Reporter(options, progress).run();
}

}  // namespace walr
