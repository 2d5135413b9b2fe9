#include "samples/bench/device_facts.h"

#include <cstdint>
#include <vector>

#include "framegraph/compile/compile.h"
#include "framegraph/vulkan/driver_memory_model.h"
#include "framegraph/vulkan/executor.h"
#include "framegraph/vulkan/frame_queue.h"

namespace walr {
namespace {

constexpr std::uint64_t kCopyBytes = 64ULL << 20U;
constexpr int kWarmUps = 2;
constexpr int kMeasurements = 9;

/// A frame with three passes: fill a buffer, copy it to another one, and an empty pass.
fg::Graph probe(const fg::vk::DeviceContext& device) {
  fg::Graph graph;
  const fg::Buffer source = graph.buffer("source", {kCopyBytes});
  const fg::Buffer destination = graph.buffer("destination", {kCopyBytes});
  fg::PassBuilder fill = graph.callback("fill", [&device, source](const fg::RecordContext& context) {
    device.functions.vkCmdFillBuffer(context.commandBuffer, context.buffer(source), 0, kCopyBytes, 0);
  });
  const fg::Buffer filled = fill.access(source, fg::Access::TransferWrite);
  fg::PassBuilder copy = graph.callback("copy", [&device, source, destination](const fg::RecordContext& context) {
    const VkBufferCopy whole{0, 0, kCopyBytes};
    device.functions.vkCmdCopyBuffer(context.commandBuffer, context.buffer(source), context.buffer(destination), 1,
                                     &whole);
  });
  copy.access(filled, fg::Access::TransferRead);
  copy.access(destination, fg::Access::TransferWrite);
  copy.sideEffects();
  graph.callback("nothing", [](const fg::RecordContext&) {}).sideEffects();
  return graph;
}

}  // namespace

DeviceFacts deviceFacts(const GpuDevice& device) {
  const fg::vk::DeviceContext& context = device.device().context();
  DeviceFacts facts;
  facts.name = device.name();
  facts.driver = device.driver();
  facts.software = device.isSoftware();
  facts.timestampNanoseconds = context.properties.limits.timestampPeriod;
  if (context.timestampBits == 0) return facts;

  const fg::Graph graph = probe(context);
  fg::CompileResult compiled = fg::compile(graph.desc(), fg::vk::DriverMemoryModel(context));
  if (!compiled.ok()) throw std::logic_error("the probe of the device does not compile:\n" + compiled.text());
  fg::vk::Executor executor(context, graph.desc(), compiled.plan, {.framesInFlight = 1, .timestamps = true});
  fg::vk::FrameQueue queue(context, device.device().queue(), 1);
  std::vector<double> copies;
  std::vector<double> nothings;
  for (int i = 0; i < kWarmUps + kMeasurements; ++i) {
    const fg::vk::Frame frame = queue.begin();
    executor.record(frame.commandBuffer, frame.slot);
    queue.submit(frame);
    queue.wait(frame.slot);
    for (const fg::vk::PassTime& time : executor.passTimes(frame.slot)) {
      if (i >= kWarmUps && time.name == "copy") copies.push_back(time.milliseconds);
      if (i >= kWarmUps && time.name == "nothing") nothings.push_back(time.milliseconds);
    }
  }
  facts.timerMilliseconds = spread(nothings);
  facts.copyBytesPerSecond = 2.0 * static_cast<double>(kCopyBytes) / (spread(copies).median * 1e-3);
  return facts;
}

}  // namespace walr
