// A host that denoises with a graph of its own, from the installed C++ libraries. The integration guide shows its lines.
#include <cstdio>
#include <stdexcept>

#include "framegraph/compile/compile.h"
#include "framegraph/vulkan/driver_memory_model.h"
#include "framegraph/vulkan/executor.h"
#include "integration/denoise_graph.h"
#include "integration/registry.h"
#include "passes/conventions/frame.h"

namespace {

/// The host's images, and the state of the frame that it records.
struct Host {
  VkImage lighting, depth, normal, motion, albedo, denoised;
  VkCommandBuffer commands;
  walr::FrameDescription camera;
};

}  // namespace

/// Compiled to hold the guide's lines against the headers; this program has no device to run it on.
void denoise(const fg::vk::DeviceContext& device, fg::Extent extent, Host& host) {
  // Once: choose a method, declare its passes, compile them to a plan, make what the plan needs.
  const auto method = walr::makeDenoiser("walr");
  method->set("accumulation.max-history", "16");
  const walr::DenoiseGraph declared = walr::declareDenoiseGraph(*method, extent, {}, walr::kComputeHost);
  const fg::CompileResult compiled = fg::compile(declared.graph.desc(), fg::vk::DriverMemoryModel(device));
  if (!compiled.ok()) throw std::runtime_error(compiled.text());
  fg::vk::Executor executor(device, declared.graph.desc(), compiled.plan);
  executor.bind(declared.inputs.lighting, {.image = host.lighting});
  executor.bind(declared.inputs.depth, {.image = host.depth});
  executor.bind(declared.inputs.normal, {.image = host.normal});
  executor.bind(declared.inputs.motion, {.image = host.motion});
  executor.bind(declared.inputs.albedo, {.image = host.albedo});
  executor.bind(declared.lights.front().output, {.image = host.denoised});

  // Every frame: the camera, then all passes with their barriers. Two frames may be on the GPU at once.
  executor.upload(declared.inputs.frame, walr::frameConstants(host.camera, extent));
  executor.record(host.commands, host.camera.frameIndex % 2);
}

int main() {
  const auto method = walr::makeDenoiser("walr");
  const walr::DenoiseGraph declared = walr::declareDenoiseGraph(*method, {640, 360}, {}, walr::kComputeHost);
  const fg::CompileResult compiled = fg::compile(declared.graph.desc(), fg::TableMemoryModel());
  std::printf("%zu pass types, %zu passes\n", walr::passTypes().size(), compiled.plan.passes.size());
  return compiled.ok() && !compiled.plan.passes.empty() ? 0 : 1;
}
