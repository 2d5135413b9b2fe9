#include "samples/gpu_report/bandwidth.h"

#include <algorithm>
#include <chrono>
#include <map>

#include "framegraph/compile/compile.h"
#include "framegraph/vulkan/error.h"
#include "framegraph/vulkan/frame_queue.h"
#include "samples/denoise/device_graph.h"
#include "samples/gpu_report/shaders.h"

namespace walr {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kSmallestSide = 128;
constexpr std::size_t kLeastRepetitions = 2;
constexpr std::chrono::seconds kLongest(3);
constexpr std::uint64_t kTexelBytes = 8;
constexpr VkFormat kFormat = VK_FORMAT_R32G32_UINT;
constexpr std::uint64_t kResultBytes = 16;
constexpr std::uint32_t kGroupSide = 8;
constexpr double kFetchesOfCachedThread = 64.0;
constexpr double kFetchesOfChain = 256.0;
constexpr std::string_view kBufferCopy = "copy buffer";
constexpr std::string_view kImageFill = "copy buffer to image";
constexpr std::string_view kImageRead = "copy image to buffer";
constexpr std::string_view kStream = "fetch every texel";
constexpr std::string_view kChain = "fetch one after the other";
constexpr std::string_view kNothing = "nothing";

/// A frame whose passes are the probes.
struct ProbeGraph {
  fg::Graph graph;
  fg::Extent extent;
  fg::Extent cachedThreads;
  std::vector<BandwidthProbe> probes;  ///< Not yet measured.
};

VkBufferImageCopy wholeImage(fg::Extent extent) {
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {extent.width, extent.height, 1};
  return region;
}

/// Adds the copies; returns the image with the noise.
fg::Texture addCopies(ProbeGraph& probe, const fg::vk::DeviceContext& device, std::uint64_t bytes) {
  fg::Graph& graph = probe.graph;
  const fg::Extent extent = probe.extent;
  const fg::vk::DeviceFunctions* functions = &device.functions;
  const fg::Buffer source = graph.buffer("source", {bytes});
  const fg::Buffer destination = graph.buffer("destination", {bytes});
  const fg::Texture image = graph.texture("texels", {.format = kFormat, .extent = extent});

  fg::PassBuilder noise = graph.compute("noise", gpu_report::shaders::noise);
  const fg::Buffer filled = noise.store("Noise", source);
  noise.dispatch({2 * extent.width, extent.height});

  fg::PassBuilder copy = graph.callback(std::string(kBufferCopy), [=](const fg::RecordContext& context) {
    const VkBufferCopy whole{0, 0, bytes};
    functions->vkCmdCopyBuffer(context.commandBuffer, context.buffer(source), context.buffer(destination), 1, &whole);
  });
  copy.access(filled, fg::Access::TransferRead);
  const fg::Buffer copied = copy.access(destination, fg::Access::TransferWrite);

  fg::PassBuilder fill = graph.callback(std::string(kImageFill), [=](const fg::RecordContext& context) {
    const VkBufferImageCopy region = wholeImage(extent);
    functions->vkCmdCopyBufferToImage(context.commandBuffer, context.buffer(destination), context.image(image),
                                      VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
  });
  fill.access(copied, fg::Access::TransferRead);
  const fg::Texture texels = fill.access(image, fg::Access::TransferWrite);

  const fg::Buffer back = graph.buffer("read back", {bytes});
  fg::PassBuilder read = graph.callback(std::string(kImageRead), [=](const fg::RecordContext& context) {
    const VkBufferImageCopy region = wholeImage(extent);
    functions->vkCmdCopyImageToBuffer(context.commandBuffer, context.image(image), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                      context.buffer(back), 1, &region);
  });
  read.access(texels, fg::Access::TransferRead);
  read.access(back, fg::Access::TransferWrite);
  read.sideEffects();
  return texels;
}

void addFetches(ProbeGraph& probe, fg::Texture texels) {
  const auto add = [&](std::string_view name, const fg::Shader& shader, fg::Extent threads) {
    const fg::Buffer result = probe.graph.buffer("result of " + std::string(name), {kResultBytes});
    fg::PassBuilder pass = probe.graph.compute(std::string(name), shader);
    pass.sample("source", texels);
    (void)pass.store("Result", result);
    pass.dispatch(threads).sideEffects();
  };
  add(kStream, gpu_report::shaders::fetchStream, {probe.extent.width, probe.extent.height / 4});
  add(kCachedFetches, gpu_report::shaders::fetchCached, probe.cachedThreads);
  add(kChain, gpu_report::shaders::fetchChain, {kGroupSide, kGroupSide});
}

ProbeGraph probeGraph(const fg::vk::DeviceContext& device, std::uint32_t side) {
  ProbeGraph probe;
  probe.extent = {2 * side, side};
  probe.cachedThreads = {side / 2, side / 4};
  const std::uint64_t bytes = kTexelBytes * probe.extent.width * probe.extent.height;
  addFetches(probe, addCopies(probe, device, bytes));
  probe.graph.callback(std::string(kNothing), [](const fg::RecordContext&) {}).sideEffects();

  const auto moved = static_cast<double>(bytes);
  const auto add = [&](std::string_view name, const char* description, double movedBytes, double fetches) {
    BandwidthProbe& entry = probe.probes.emplace_back();
    entry.name = name;
    entry.description = description;
    entry.bytes = movedBytes;
    entry.fetches = fetches;
  };
  add(kBufferCopy, "vkCmdCopyBuffer; bytes read plus written", 2.0 * moved, 0.0);
  add(kImageFill, "vkCmdCopyBufferToImage; bytes read plus written", 2.0 * moved, 0.0);
  add(kImageRead, "vkCmdCopyImageToBuffer; bytes read plus written", 2.0 * moved, 0.0);
  add(kStream, "compute pass that fetches every texel of 8 bytes once", moved, moved / kTexelBytes);
  add(kCachedFetches, "compute pass of 64 fetches a thread from a window of 8 x 8 texels", 0.0,
      kFetchesOfCachedThread * probe.cachedThreads.width * probe.cachedThreads.height);
  add(kChain, "one work group, each of whose fetches needs the result of the one before", 0.0, kFetchesOfChain);
  return probe;
}

/// Times of every pass over the measured repetitions.
std::map<std::string, std::vector<double>> passTimes(const GpuDevice& device, const fg::Graph& graph,
                                                     std::size_t repetitions) {
  DeviceGraph onDevice(device, graph, 1);
  fg::vk::FrameQueue queue(device.device().context(), device.device().queue(), 1);
  const auto run = [&] {
    const fg::vk::Frame frame = queue.begin();
    onDevice.executor().record(frame.commandBuffer, frame.slot);
    queue.submit(frame);
    queue.wait(frame.slot);
    return onDevice.executor().passTimes(frame.slot);
  };
  /// Whether to run once more. A slow device runs fewer times.
  auto more = [&, start = Clock::now()](std::size_t done) mutable {
    if (done == 0) start = Clock::now();
    return done < kLeastRepetitions || (done < repetitions && Clock::now() - start < kLongest);
  };
  for (std::size_t i = 0; more(i); ++i) run();
  std::map<std::string, std::vector<double>> times;
  for (std::size_t i = 0; more(i); ++i) {
    for (const fg::vk::PassTime& time : run()) times[time.name].push_back(time.milliseconds);
  }
  return times;
}

void fillIn(BandwidthProbe& probe, const std::vector<double>& milliseconds) {
  probe.milliseconds = spread(milliseconds);
  const double seconds = probe.milliseconds.median * 1e-3;
  if (seconds <= 0.0) return;
  if (probe.bytes > 0.0) probe.bytesPerSecond = probe.bytes / seconds;
  if (probe.name == kChain) {
    probe.secondsPerFetch = seconds / probe.fetches;
  } else if (probe.fetches > 0.0) {
    probe.fetchesPerSecond = probe.fetches / seconds;
  }
}

}  // namespace

const BandwidthProbe* Bandwidth::find(std::string_view name) const {
  const auto found = std::ranges::find(probes, name, &BandwidthProbe::name);
  return found == probes.end() ? nullptr : &*found;
}

std::optional<double> Bandwidth::bytesPerSecond() const {
  std::optional<double> most;
  for (const BandwidthProbe& probe : probes) most = std::max(most, probe.bytesPerSecond);  // Nothing is the least.
  return most;
}

Bandwidth measureBandwidth(const GpuDevice& device, std::uint32_t side, std::size_t repetitions) {
  const fg::vk::DeviceContext& context = device.device().context();
  Bandwidth bandwidth;
  if (context.timestampBits == 0) {
    bandwidth.whyNot = "the device's queue has no timestamps";
    return bandwidth;
  }
  for (;; side /= 2) {
    try {
      ProbeGraph probe = probeGraph(context, side);
      const auto times = passTimes(device, probe.graph, repetitions);
      bandwidth.bytes = kTexelBytes * probe.extent.width * probe.extent.height;
      bandwidth.emptyPassMilliseconds = spread(times.at(std::string(kNothing)));
      for (BandwidthProbe& entry : probe.probes) fillIn(entry, times.at(entry.name));
      bandwidth.probes = std::move(probe.probes);
      return bandwidth;
    } catch (const fg::vk::OutOfMemory& error) {
      bandwidth.whyNot = error.what();
      if (side <= kSmallestSide) return bandwidth;
    }
  }
}

}  // namespace walr
