#include "passes/guides/convert_inputs.h"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "passes/conventions/orthographic.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

constexpr VkFormat kColour = VK_FORMAT_R16G16B16A16_SFLOAT;

/// A conversion without its output.
fg::PassBuilder convert(StageGraph graph, const std::string& what, const fg::Shader& shader, fg::Texture source,
                        fg::Buffer host) {
  fg::PassBuilder pass = graph.compute("convert " + what, shader);
  pass.sample("source", source).uniform("hostConstants", host).dispatch(graph.textureDesc(source).extent);
  return pass;
}

fg::Texture converted(StageGraph graph, const std::string& what, VkFormat format, fg::Texture source) {
  return graph.texture("converted " + what, {format, graph.textureDesc(source).extent});
}

fg::Texture convertDepth(StageGraph graph, fg::Texture depth, const HostConventions& conventions, fg::Buffer host) {
  const HostConventions::Depth kind = conventions.depth;
  fg::PassBuilder pass = convert(graph, "depth", shaders::convertInputDepth, depth, host);
  pass.specialize("kDevice", kind == HostConventions::Depth::Device)
      .specialize("kNegative", kind == HostConventions::Depth::NegativeLinear)
      .specialize("kOrthographic", conventions.orthographic);
  return pass.store("target", converted(graph, "depth", VK_FORMAT_R32_SFLOAT, depth));
}

fg::Texture convertNormal(StageGraph graph, fg::Texture normal, const HostConventions& conventions, fg::Buffer host) {
  using Normal = HostConventions::Normal;
  const Normal kind = conventions.normal;
  fg::PassBuilder pass = convert(graph, "normal", shaders::convertInputNormal, normal, host);
  pass.specialize("kUnsigned", kind == Normal::Unsigned || kind == Normal::OctahedralUnsigned)
      .specialize("kOctahedral", conventions.octahedral());
  return pass.store("target", converted(graph, "normal", kColour, normal));
}

/// What a conversion does to the values of a texture.
struct ValueChange {
  bool back = false;  ///< To the host's texture, not from it.
  bool exposed = false;
  bool reversed = false;
};

fg::PassBuilder convertValues(StageGraph graph, const std::string& what, const fg::Shader& shader, fg::Texture source,
                              fg::Buffer host, const ValueChange& change) {
  fg::PassBuilder pass = convert(graph, what, shader, source, host);
  pass.specialize("kBack", change.back).specialize("kExposed", change.exposed).specialize("kReversed", change.reversed);
  return pass;
}

fg::Texture convertMotion(StageGraph graph, fg::Texture motion, bool reversed, fg::Buffer host) {
  // Single precision: halves are too coarse for motion in units of the image's size (UV).
  return convertValues(graph, "motion", shaders::convertInputValuesSingle, motion, host, {.reversed = reversed})
      .store("target", converted(graph, "motion", VK_FORMAT_R32G32B32A32_SFLOAT, motion));
}

fg::Texture convertColour(StageGraph graph, const std::string& what, fg::Texture source, bool exposed,
                          fg::Buffer host) {
  return convertValues(graph, what, shaders::convertInputValues, source, host, {.exposed = exposed})
      .store("target", converted(graph, what, kColour, source));
}

const fg::Shader& resultShader(VkFormat format) {
  switch (format) {
    case VK_FORMAT_R32G32B32A32_SFLOAT:
      return shaders::convertInputValuesSingle;
    case VK_FORMAT_B10G11R11_UFLOAT_PACK32:
      return shaders::convertInputValuesPacked;
    default:
      return shaders::convertInputValues;
  }
}

}  // namespace

HostConstants hostConstants(const glm::mat4& projection, float exposure, glm::ivec2 offset) {
  if (!(exposure > 0.0F && std::isfinite(exposure) && std::isfinite(1.0F / exposure))) {
    std::ostringstream text;
    text << "the exposure is " << exposure << ": it must be more than 0 and finite, and so must its inverse";
    throw std::invalid_argument(text.str());
  }
  const bool orthographic = isOrthographic(projection);
  const glm::vec2 zRow(projection[3][2], projection[2][2]);
  // Device depth = (z row * view position).z / depth, where z of view space is -depth: -[2][2] + [3][2] / depth.
  // An orthographic camera's is [3][2] - [2][2] * depth.
  return {.depthFromDevice = orthographic ? glm::vec2(zRow.x / zRow.y, -1.0F / zRow.y) : zRow,
          .exposure = exposure,
          .inverseExposure = 1.0F / exposure,
          .offset = offset,
          .standOff = orthographic ? static_cast<float>(standOff(projection)) : 0.0F};
}

DenoiserInputs addConvertInputs(StageGraph graph, DenoiserInputs inputs, const HostConventions& conventions,
                                fg::Buffer host) {
  const bool all = conventions.rectangle;
  if (all || conventions.orthographic || conventions.depth != HostConventions::Depth::Linear) {
    inputs.depth = convertDepth(graph, inputs.depth, conventions, host);
  }
  if (all || conventions.normal != HostConventions::Normal::Signed) {
    inputs.normal = convertNormal(graph, inputs.normal, conventions, host);
  }
  if (all || conventions.motionDepthReversed) {
    inputs.motion = convertMotion(graph, inputs.motion, conventions.motionDepthReversed, host);
  }
  inputs = addConvertLight(graph, inputs, conventions, host);
  const auto move = [&](const char* what, fg::Texture& texture) {
    if (all && texture.valid()) texture = convertColour(graph, what, texture, false, host);
  };
  move("albedo", inputs.albedo);
  move("specular albedo", inputs.specularAlbedo);
  move("roughness", inputs.roughness);
  move("specular motion", inputs.specularMotion);
  if (all && inputs.objectId.valid()) {
    inputs.objectId = convert(graph, "object numbers", shaders::convertInputNumbers, inputs.objectId, host)
                          .store("target", converted(graph, "object numbers", VK_FORMAT_R32_UINT, inputs.objectId));
  }
  return inputs;
}

DenoiserInputs addConvertLight(StageGraph graph, DenoiserInputs inputs, const HostConventions& conventions,
                               fg::Buffer host) {
  if (conventions.rectangle || conventions.preExposed) {
    inputs.lighting = convertColour(graph, "lighting", inputs.lighting, true, host);
  }
  if (conventions.rectangle && inputs.confidence.valid()) {
    inputs.confidence = convertColour(graph, "confidence", inputs.confidence, false, host);
  }
  return inputs;
}

fg::Texture addConvertResult(StageGraph graph, fg::Texture denoised, fg::Texture output, fg::Buffer host) {
  return convertValues(graph, "result", resultShader(graph.textureDesc(output).format), denoised, host,
                       {.back = true, .exposed = true})
      .store("target", output);
}

}  // namespace walr
