#include "tests/passes/host_textures.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include <glm/gtc/packing.hpp>
#include <glm/packing.hpp>

#include "tests/passes/reference/octahedral.h"
#include "tests/passes/shaders.h"
#include "tests/passes/texel_codec.h"

namespace walr::test {
namespace {

using reference::Image;

fg::Extent extentOf(glm::ivec2 size) {
  return {static_cast<std::uint32_t>(size.x), static_cast<std::uint32_t>(size.y)};
}

fg::Texture import(fg::Graph& graph, const std::string& name, VkFormat format, glm::ivec2 size) {
  return graph.import(name, {format, extentOf(size)}, fg::vk::kUploaded);
}

std::uint32_t packUnorms(glm::dvec2 unorms) {
  return glm::packUnorm2x16(glm::vec2(reference::roundToUnorms(unorms)));
}

/// Pack the shading normal into twice 12 bits and ambient occlusion into 8.
std::uint32_t packFeatures(const reference::Guide& guide) {
  const auto unorm = [](double value, double step) { return static_cast<std::uint32_t>(std::lround(value / step)); };
  return unorm(guide.features.x, reference::kUnorm12Step) | (unorm(guide.features.y, reference::kUnorm12Step) << 12U) |
         (unorm(guide.occlusion, reference::kUnorm8Step) << 24U);
}

/// Upload depths and geometric normals, the guides that have a history.
/// @param geometricNormal not valid if `depth` holds both
void uploadDepthAndGeometry(fg::test::GraphRun& run, fg::Texture depth, fg::Texture geometricNormal,
                            const Image<reference::Guide>& values) {
  std::vector<std::uint32_t> depths;
  std::vector<std::uint32_t> normals;
  for (const reference::Guide& guide : values.pixels()) {
    const bool surface = guide.depth > 0.0;
    if (geometricNormal.valid()) {
      depths.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(guide.depth)));
      normals.push_back(surface ? packUnorms(reference::octahedralEncode(guide.normal)) : 0U);
    } else {
      depths.push_back(surface ? encodeDepthNormal(guide.depth, guide.normal) : 0U);
    }
  }
  run.fill(depth, depths);
  if (geometricNormal.valid()) run.fill(geometricNormal, normals);
}

}  // namespace

DenoiserInputs importInputs(fg::Graph& graph, glm::ivec2 size, const InputConventions& conventions,
                            bool specularMotion) {
  DenoiserInputs inputs;
  const fg::Extent lightExtent = conventions.light.lightingExtent(extentOf(size));
  inputs.lighting = importHalves(graph, "lighting", glm::ivec2(lightExtent.width, lightExtent.height));
  inputs.depth = import(graph, "depth", VK_FORMAT_R32_SFLOAT, size);
  inputs.normal = importHalves(graph, "normal", size);
  inputs.motion = importHalves(graph, "motion", size);
  inputs.albedo = importHalves(graph, "albedo", size);
  inputs.specularAlbedo = inputs.albedo;
  if (conventions.specular) inputs.roughness = import(graph, "roughness", VK_FORMAT_R8_UNORM, size);
  if (specularMotion) inputs.specularMotion = importHalves(graph, "specular_motion", size);
  inputs.frame = graph.upload("frame constants", sizeof(FrameConstants));
  inputs.conventions = conventions;
  return inputs;
}

fg::Texture importObjectIds(fg::Graph& graph, glm::ivec2 size) {
  return import(graph, "object_id", VK_FORMAT_R32_UINT, size);
}

void upload(fg::test::GraphRun& run, const DenoiserInputs& inputs, const reference::HostFrame& frame) {
  run.fill(inputs.lighting, encodeLighting(frame));
  run.fill(inputs.normal, encodeHalves(frame.normal));
  run.fill(inputs.motion, encodeHalves(frame.motion));
  run.fill(inputs.albedo, encodeHalves(frame.albedo));
  run.fill(inputs.depth, encodeFloats(frame.depth));
  if (inputs.roughness.valid()) run.fill(inputs.roughness, encodeRoughness(frame));
  if (inputs.specularMotion.valid()) run.fill(inputs.specularMotion, encodeHalves(frame.specularMotion));
  if (inputs.objectId.valid()) run.fill(inputs.objectId, frame.objectId.pixels());
  run.executor().upload(inputs.frame, frame.constants);
}

Guides importGuides(fg::Graph& graph, glm::ivec2 size, bool occlusion) {
  Guides guides;
  guides.depth = import(graph, "guides.depth", VK_FORMAT_R32_UINT, size);
  guides.previousDepth = import(graph, "previous guides.depth", VK_FORMAT_R32_UINT, size);
  if (occlusion) {
    guides.features = import(graph, "guides.features", VK_FORMAT_R32_UINT, size);
    return guides;
  }
  guides.shadingNormal = import(graph, "guides.shading normal", VK_FORMAT_R32_UINT, size);
  guides.geometricNormal = import(graph, "guides.geometric normal", VK_FORMAT_R32_UINT, size);
  guides.previousGeometricNormal = import(graph, "previous guides.geometric normal", VK_FORMAT_R32_UINT, size);
  return guides;
}

void upload(fg::test::GraphRun& run, const Guides& guides, const Image<reference::Guide>& values) {
  std::vector<std::uint32_t> shadingNormals;
  std::vector<std::uint32_t> features;
  for (const reference::Guide& guide : values.pixels()) {
    shadingNormals.push_back(packUnorms(guide.features));
    features.push_back(packFeatures(guide));
  }
  if (guides.shadingNormal.valid()) run.fill(guides.shadingNormal, shadingNormals);
  if (guides.features.valid()) run.fill(guides.features, features);
  uploadDepthAndGeometry(run, guides.depth, guides.geometricNormal, values);
}

void uploadPrevious(fg::test::GraphRun& run, const Guides& guides, const Image<reference::Guide>& values) {
  uploadDepthAndGeometry(run, guides.previousDepth, guides.previousGeometricNormal, values);
}

fg::Texture importHalves(fg::Graph& graph, const std::string& name, glm::ivec2 size) {
  return import(graph, name, VK_FORMAT_R16G16B16A16_SFLOAT, size);
}

void upload(fg::test::GraphRun& run, fg::Texture texture, const Image<glm::dvec4>& values) {
  std::vector<std::uint64_t> texels;
  for (const glm::dvec4& value : values.pixels()) texels.push_back(glm::packHalf4x16(glm::vec4(value)));
  run.fill(texture, texels);
}

Image<glm::dvec4> withAlpha(const Image<glm::dvec3>& image) {
  Image<glm::dvec4> result(image.size());
  reference::forEachPixel(image.size(), [&](glm::ivec2 p) { result[p] = glm::dvec4(image[p], 0.0); });
  return result;
}

fg::Texture importOutput(fg::Graph& graph, glm::ivec2 size) {
  return graph.import("output", {VK_FORMAT_R16G16B16A16_SFLOAT, extentOf(size)}, fg::vk::kOverwritable);
}

fg::Texture copyOut(fg::Graph& graph, const std::string& name, fg::Texture texture) {
  const fg::Extent extent = graph.textureDesc(texture).extent;
  const fg::Texture target = graph.import(name, {VK_FORMAT_R16G16B16A16_SFLOAT, extent}, fg::vk::kOverwritable);
  fg::PassBuilder pass = graph.compute("copy to " + name, shaders::copyHalf);
  pass.sample("source", texture).dispatch(extent);
  graph.exported(pass.store("target", target), fg::vk::kReadable);
  return target;
}

Image<glm::dvec4> readHalves(const fg::test::GraphRun& run, fg::Texture output, glm::ivec2 size) {
  return decodeHalves(run.texels<std::uint16_t>(output), size);
}

}  // namespace walr::test
