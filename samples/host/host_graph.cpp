#include "samples/host/host_graph.h"

#include <algorithm>

#include "framegraph/vulkan/staged_image.h"
#include "passes/lint/lint_inputs.h"
#include "passes/lint/lint_specular.h"
#include "passes/stage/inspection.h"
#include "samples/command_line/usage_error.h"
#include "samples/host/shaders/view_constants.h"
#include "shaders/conventions/frame.h"

namespace walr::host {
namespace {

// What the names of the passes and histories of specular light that is denoised begin with, behind `kComparedPrefix`,
// if any.
constexpr std::string_view kSpecularPrefix = "specular: ";
constexpr VkFormat kColourFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr VkFormat kDepthFormat = VK_FORMAT_R32_SFLOAT;
constexpr VkFormat kDisplayFormat = VK_FORMAT_R8G8B8A8_UNORM;

fg::Texture declareTarget(fg::Graph& graph, const std::string& name, const fg::TextureDesc& desc,
                          const std::optional<HostTargets::Target>& target) {
  return target ? graph.import(name, desc, target->before) : graph.texture(name, desc);
}

void exportTarget(fg::Graph& graph, fg::Texture texture, const std::optional<HostTargets::Target>& target) {
  if (target) {
    graph.exported(texture, target->after);
  }
}

/// Whether a view can sample this resource: a texture with one layer that a pass or the host fills. The previous
/// frame's contents of a history, which are a resource of their own, are left out.
bool isViewable(const fg::ResourceDecl& resource) {
  const auto* texture = std::get_if<fg::TextureDesc>(&resource.desc);
  const bool filled = resource.versions > 0 || resource.lifetime == fg::Lifetime::Imported;
  return texture != nullptr && texture->arrayLayers == 1 && filled &&
         resource.lifetime != fg::Lifetime::HistoryPrevious;
}

/// The last version of the texture of this name.
fg::Texture findTexture(const fg::GraphDesc& graph, const std::string& name) {
  for (std::uint32_t i = 0; i < graph.resources.size(); ++i) {
    if (graph.resources[i].name == name && isViewable(graph.resources[i])) {
      return fg::Texture{{i, graph.resources[i].versions}};
    }
  }
  std::string known;
  for (const std::string& texture : viewableTextures(graph)) {
    known += (known.empty() ? "'" : ", '") + texture + "'";
  }
  throw UsageError("the frame has no texture '" + name + "'; it has " + known);
}

void declareInputs(HostGraph& host, fg::Extent extent, const HostView& view, const LightPattern& light, bool specular,
                   const fg::vk::DeviceContext& device) {
  fg::Graph& graph = host.graph;
  std::vector<UploadedPicture*> uploads;
  const auto picture = [&](UploadedPicture& target, const char* name, VkFormat format) {
    target = declarePicture(graph, name, format, extent);
    uploads.push_back(&target);
  };
  host.lighting = declarePicture(graph, "lighting", kColourFormat, light.lightingExtent(extent));
  uploads.push_back(&host.lighting);
  if (!light.everyPixel() && view.needsNoisy()) picture(host.noisyLight.emplace(), "noisy light", kColourFormat);
  picture(host.depth, "depth", kDepthFormat);
  picture(host.normal, "normal", kColourFormat);
  picture(host.motion, "motion", kColourFormat);
  picture(host.albedo, "albedo", kColourFormat);
  picture(host.objectId, "object id", VK_FORMAT_R32_UINT);
  picture(host.direct, "direct light", kColourFormat);
  picture(host.emission, "emission", kColourFormat);
  if (specular) {
    picture(host.specular.emplace(), "specular light", kColourFormat);
    picture(host.specularAlbedo.emplace(), "specular albedo", kColourFormat);
    picture(host.roughness.emplace(), "roughness", VK_FORMAT_R8_UNORM);
    picture(host.specularMotion.emplace(), "specular motion", kColourFormat);
    if (view.needsReference()) picture(host.referenceSpecular.emplace(), "reference specular light", kColourFormat);
  }
  if (view.needsReference()) {
    picture(host.referenceIndirect.emplace(), "reference", kColourFormat);
    picture(host.referenceDirect.emplace(), "reference direct light", kColourFormat);
  }
  addUploads(graph, device, uploads);
}

/// The same inputs, traced on the device.
void declareTracedInputs(HostGraph& host, fg::Extent extent, const HostView& view, const LightPattern& light,
                         const gpu_render::GpuScene& scene) {
  if (!light.everyPixel()) {
    throw UsageError(
        "--light-rate: in this program only the path tracer on the processor traces sparse light: use "
        "--tracer cpu");
  }
  if (view.needsReference()) {
    throw UsageError("views with a reference need the path tracer on the processor: use --tracer cpu, or another view");
  }
  fg::Graph& graph = host.graph;
  const auto color = [&](const char* name) { return graph.texture(name, {.format = kColourFormat, .extent = extent}); };
  gpu_render::TracedTextures traced{
      .direct = color("direct light"),
      .indirect = color("lighting"),
      .normal = color("normal"),
      .albedo = color("albedo"),
      .emission = color("emission"),
      .motion = color("motion"),
      .depth = graph.texture("depth", {.format = kDepthFormat, .extent = extent}),
      .objectId = graph.texture("object id", {.format = VK_FORMAT_R32_UINT, .extent = extent})};
  if (scene.specular()) {
    traced.specular = color("traced specular light");
    traced.specularAlbedo = color("specular albedo");
    traced.specularMotion = color("specular motion");
  }
  host.trace = gpu_render::declareTraceInputs(graph, scene);
  gpu_render::addTrace(graph, scene, gpu_render::Precision::Half, *host.trace, traced);
  host.direct.texture = traced.direct;
  host.lighting.texture = traced.indirect;
  host.normal.texture = traced.normal;
  host.albedo.texture = traced.albedo;
  host.emission.texture = traced.emission;
  host.motion.texture = traced.motion;
  host.depth.texture = traced.depth;
  host.objectId.texture = traced.objectId;
  if (scene.specular()) {
    const SpecularInputs inputs = addSpecularInputs(graph, traced.specular, traced.specularAlbedo, traced.normal);
    host.specular.emplace().texture = inputs.lighting;
    host.roughness.emplace().texture = inputs.roughness;
    host.specularAlbedo.emplace().texture = traced.specularAlbedo;
    host.specularMotion.emplace().texture = traced.specularMotion;
  }
  const fg::BufferDesc row{std::uint64_t{extent.height} * sizeof(std::uint32_t)};
  host.rays = addRayCount(graph, traced.indirect, graph.import("rays", row, fg::vk::kOverwritable));
  graph.exported(*host.rays, fg::vk::kReadable);
}

/// What composites take beside the indirect light, with specular light as it was traced.
Shading shadingOf(const HostGraph& host) {
  Shading shading{host.direct.texture, host.albedo.texture, host.emission.texture};
  if (host.specular) {
    shading.specular = host.specular->texture;
    shading.specularAlbedo = host.specularAlbedo->texture;
  }
  return shading;
}

/// Inputs of specular light, which the host must have.
/// @param inputs of diffuse light
DenoiserInputs specularInputs(const HostGraph& host, DenoiserInputs inputs) {
  inputs.lighting = host.specular->texture;
  inputs.specularAlbedo = host.specularAlbedo->texture;
  inputs.roughness = host.roughness->texture;
  inputs.specularMotion = host.specularMotion->texture;
  inputs.conventions.specular = true;
  return inputs;
}

/// Denoise what a method takes of the frame, and light the image with it.
/// @param denoised  what diffuse light is written to, replaced by the written version
/// @param lit       what the image is written to
/// @returns the image
fg::Texture addLit(HostGraph& host, Denoiser& method, const DenoiserInputs& inputs, const std::string& prefix,
                   fg::Texture& denoised, fg::Texture lit) {
  fg::Graph& graph = host.graph;
  Inspection nothing;
  Shading shading = shadingOf(host);
  denoised = method.add(StageGraph(graph, nothing, {.prefix = prefix}), inputs, denoised);
  if (host.specular && method.takesSpecularLight()) {
    const std::string specular = prefix + std::string(kSpecularPrefix);
    const fg::Texture output = graph.texture(specular + "denoised", graph.textureDesc(denoised));
    shading.specular =
        method.add(StageGraph(graph, nothing, {.prefix = specular}), specularInputs(host, inputs), output);
  }
  return addComposite(graph, prefix + "composite", denoised, shading, lit);
}

/// The lit image of another light source than the denoiser. The composite of the denoised light exists in any case.
fg::Texture litBy(HostGraph& host, HostView::Kind source) {
  if (source == HostView::Kind::Denoised) {
    return host.composite;
  }
  const bool noisy = source == HostView::Kind::Noisy;
  const std::string name = noisy ? "composite noisy" : "composite reference";
  const fg::Texture output =
      host.graph.texture(noisy ? "lit noisy" : "lit reference", host.graph.textureDesc(host.composite));
  const UploadedPicture& traced = host.noisyLight ? *host.noisyLight : host.lighting;
  const fg::Texture indirect = noisy ? traced.texture : host.referenceIndirect->texture;
  Shading shading = shadingOf(host);
  if (!noisy) shading.direct = host.referenceDirect->texture;
  if (!noisy && shading.specular) shading.specular = host.referenceSpecular->texture;
  return addComposite(host.graph, name, indirect, shading, output);
}

/// The lit image of the method that is compared, which gets the same inputs.
fg::Texture litByCompared(HostGraph& host, Denoiser& compared, DenoiserInputs inputs) {
  fg::Graph& graph = host.graph;
  // Passes beside each other cannot be timed apart: this one has no work, but the second method starts after the first.
  fg::PassBuilder start = graph.callback(std::string(kComparedPrefix) + "start", [](const fg::RecordContext&) {});
  start.access(host.composite, fg::Access::SampledRead);
  for (fg::Texture* const input : {&inputs.lighting, &inputs.depth, &inputs.normal, &inputs.motion}) {
    *input = start.access(*input, fg::Access::StorageReadWrite);
  }
  const auto texture = [&](const char* name) {
    return graph.texture(std::string(kComparedPrefix) + name, graph.textureDesc(host.composite));
  };
  fg::Texture denoised = texture("denoised");
  return addLit(host, compared, inputs, std::string(kComparedPrefix), denoised, texture("lit"));
}

void addView(HostGraph& host, const HostView& view, const DenoiserInputs& inputs) {
  fg::Graph& graph = host.graph;
  const fg::Buffer constants = graph.upload("view constants", sizeof(ViewConstants));
  host.viewConstants = constants;
  if (view.kind == HostView::Kind::Texture) {
    host.display = addInspection(graph, findTexture(graph.desc(), view.texture),
                                 graph.textureDesc(host.composite).extent, constants, host.display);
  } else if (view.kind == HostView::Kind::Compare) {
    const fg::Texture right = litByCompared(host, *view.compared, inputs);
    host.display = addComparison(graph, host.composite, right, constants, host.display);
  } else if (view.kind == HostView::Kind::Split) {
    const fg::Texture noisy = litBy(host, HostView::Kind::Noisy);
    const fg::Texture reference = litBy(host, HostView::Kind::Reference);
    host.display = addSplitToneMap(graph, noisy, host.composite, reference, constants, host.display);
  } else {
    host.display = addToneMap(graph, litBy(host, view.kind), constants, host.display);
  }
}

}  // namespace

HostGraph declareHostGraph(const fg::vk::DeviceContext& device, Denoiser& method, fg::Extent extent,
                           const HostView& view, const HostTargets& targets, const LightPattern& light,
                           const std::function<void(fg::Graph&, fg::Texture display)>& present,
                           const gpu_render::GpuScene* scene, bool specular) {
  if (specular && !light.everyPixel()) {
    throw UsageError(
        "--specular and --light-rate: specular light has samples where indirect light has them, so that the picture "
        "would have holes; leave out one of them");
  }
  HostGraph host;
  fg::Graph& graph = host.graph;
  if (scene != nullptr) {
    declareTracedInputs(host, extent, view, light, *scene);
  } else {
    declareInputs(host, extent, view, light, specular, device);
  }
  host.frameConstants = graph.upload("frame constants", sizeof(FrameConstants));

  const fg::TextureDesc colour{.format = kColourFormat, .extent = extent};
  const DenoiserInputs inputs{.lighting = host.lighting.texture,
                              .depth = host.depth.texture,
                              .normal = host.normal.texture,
                              .motion = host.motion.texture,
                              .albedo = host.albedo.texture,
                              .objectId = host.objectId.texture,
                              .frame = host.frameConstants,
                              .conventions = {.light = light}};
  if (view.lint) {
    const fg::Buffer counts = graph.import("lint counters", fg::BufferDesc{kLintBytes}, fg::vk::kOverwritable);
    host.lint = addLintInputs(graph, inputs, counts);
    if (host.specular) {
      const fg::Texture diffuse = light.fullSize() ? inputs.lighting : fg::Texture{};
      host.lint = addLintSpecular(graph, {.inputs = specularInputs(host, inputs), .diffuse = diffuse}, *host.lint);
    }
    graph.exported(*host.lint, fg::vk::kReadable);
  }
  host.denoised = declareTarget(graph, "denoised", colour, targets.denoised);
  host.composite =
      addLit(host, method, inputs, "", host.denoised, declareTarget(graph, "lit", colour, targets.composite));
  host.display = declareTarget(
      graph, "display", {.format = kDisplayFormat, .extent = targets.displayExtent.value_or(extent)}, targets.display);
  addView(host, view, inputs);

  exportTarget(graph, host.denoised, targets.denoised);
  exportTarget(graph, host.composite, targets.composite);
  exportTarget(graph, host.display, targets.display);
  if (present) {
    present(graph, host.display);
  }
  return host;
}

std::vector<std::string> viewableTextures(const fg::GraphDesc& graph) {
  std::vector<std::string> names;
  for (const fg::ResourceDecl& resource : graph.resources) {
    if (isViewable(resource) && resource.name != "display") {
      names.push_back(resource.name);
    }
  }
  std::ranges::sort(names);
  return names;
}

}  // namespace walr::host
