#include "samples/host/renderer.h"

#include <numeric>

namespace walr::host {
namespace {

HostTargets targetsOf(const Renderer::Options& options) {
  constexpr HostTargets::Target kReadBack{fg::vk::kOverwritable, fg::vk::kReadable};
  HostTargets targets;
  targets.display = kReadBack;
  if (options.readComposite) {
    targets.composite = kReadBack;
  }
  if (options.readDenoised) {
    targets.denoised = kReadBack;
  }
  return targets;
}

}  // namespace

Renderer::Renderer(const GpuDevice& gpu, Denoiser& method, fg::Extent extent, const Options& options)
    : extent_(extent),
      options_(options),
      host_(declareHostGraph(gpu.device().context(), method, extent, options.view, targetsOf(options), options.light,
                             {}, options.scene, options.specular)),
      graph_(gpu, host_.graph, options.framesInFlight),
      display_(graph_.readBack(host_.display)) {
  if (options.readComposite) composite_ = graph_.readBack(host_.composite);
  if (options.readDenoised) denoised_ = graph_.readBack(host_.denoised);
  if (host_.rays) rays_ = graph_.readBack(*host_.rays);
}

void Renderer::submit(const HostFrame& frame) {
  const fg::vk::Frame recorded = graph_.begin();
  uploadFrame(graph_.executor(), host_, frame, options_.viewConstants);
  graph_.submit(recorded);
  submitted_.push_back({frame.inputs.frame.number, frame.traced});
}

std::optional<RenderedFrame> Renderer::finish() {
  if (submitted_.empty()) {
    return std::nullopt;
  }
  const std::uint32_t slot = graph_.finish();
  RenderedFrame frame;
  frame.number = submitted_.front().number;
  frame.traced = submitted_.front().traced;
  submitted_.pop_front();
  frame.display = graph_.read<std::uint32_t>(display_, slot);
  const auto readImage = [&](const std::optional<ReadbackGraph::Index>& image) {
    return image ? unpackRgb(graph_.read<Rgba16>(*image, slot), static_cast<int>(extent_.width),
                             static_cast<int>(extent_.height))
                 : Image();
  };
  frame.composite = readImage(composite_);
  frame.denoised = readImage(denoised_);
  const auto times = graph_.executor().passTimes(slot);
  frame.passTimes.assign(times.begin(), times.end());
  if (rays_) frame.traced = tracedByDevice(graph_.read<std::uint32_t>(*rays_, slot), frame.passTimes);
  return frame;
}

TracedRays tracedByDevice(std::span<const std::uint32_t> rows, std::span<const fg::vk::PassTime> passTimes) {
  constexpr double kSecond = 1000.0;  // Milliseconds.
  TracedRays traced{std::accumulate(rows.begin(), rows.end(), std::uint64_t{0}), 0.0};
  for (const fg::vk::PassTime& pass : passTimes) {
    if (pass.name == gpu_render::kTracePass) traced.seconds += pass.milliseconds / kSecond;
  }
  return traced;
}

void uploadFrame(fg::vk::Executor& executor, const HostGraph& graph, const HostFrame& frame,
                 const ViewConstants& view) {
  const PackedFrame& inputs = frame.inputs;
  executor.upload(graph.frameConstants, frame.constants);
  executor.upload(graph.viewConstants, view);
  if (inputs.frame.resetHistory) executor.resetAllHistory();
  if (graph.trace) {
    gpu_render::uploadTrace(executor, *graph.trace, *frame.trace);
    return;
  }
  const auto upload = [&](const UploadedPicture& picture, auto texels) {
    executor.upload(picture.bytes, std::as_bytes(std::span(texels.data(), texels.size())));
  };
  upload(graph.lighting, std::span(inputs.lighting));
  if (graph.noisyLight) upload(*graph.noisyLight, std::span(frame.noisyLight));
  upload(graph.depth, inputs.frame.depth.values());
  upload(graph.normal, std::span(inputs.normal));
  upload(graph.motion, std::span(inputs.motion));
  upload(graph.albedo, std::span(inputs.lobe.albedo));
  upload(graph.objectId, std::span(inputs.objectId));
  upload(graph.direct, std::span(frame.direct));
  upload(graph.emission, std::span(frame.emission));
  if (graph.specular) {
    upload(*graph.specular, std::span(frame.specular.lighting));
    upload(*graph.specularAlbedo, std::span(frame.specular.lobe.albedo));
    upload(*graph.roughness, std::span(frame.specular.lobe.roughness));
    upload(*graph.specularMotion, std::span(frame.specular.lobe.motion));
  }
  if (graph.referenceIndirect) {
    upload(*graph.referenceIndirect, std::span(frame.referenceIndirect));
    upload(*graph.referenceDirect, std::span(frame.referenceDirect));
    if (graph.referenceSpecular) upload(*graph.referenceSpecular, std::span(frame.referenceSpecular));
  }
}

}  // namespace walr::host
