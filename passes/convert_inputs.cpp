#include "passes/convert_inputs.h"

#include <stdexcept>
#include <string>

#include "shaders/shaders.h"

namespace walr {
namespace {

/// A conversion without its output.
fg::PassBuilder convert(fg::Graph& graph, const std::string& what, const fg::Shader& shader, fg::Texture source) {
  fg::PassBuilder pass = graph.compute("convert " + what, shader);
  pass.sample("source", source).dispatch(graph.textureDesc(source).extent);
  return pass;
}

fg::Texture converted(fg::Graph& graph, const std::string& what, VkFormat format, fg::Texture source) {
  return graph.texture("converted " + what, {format, graph.textureDesc(source).extent});
}

fg::Texture convertDepth(fg::Graph& graph, fg::Texture depth, HostConventions::Depth kind, fg::Buffer host) {
  fg::PassBuilder pass = convert(graph, "depth", shaders::convertInputDepth, depth);
  pass.uniform("hostConstants", host).specialize("kDevice", kind == HostConventions::Depth::Device);
  return pass.store("target", converted(graph, "depth", VK_FORMAT_R32_SFLOAT, depth));
}

fg::Texture convertNormal(fg::Graph& graph, fg::Texture normal, const HostConventions& conventions) {
  using Normal = HostConventions::Normal;
  const Normal kind = conventions.normal;
  fg::PassBuilder pass = convert(graph, "normal", shaders::convertInputNormal, normal);
  pass.specialize("kUnsigned", kind == Normal::Unsigned || kind == Normal::OctahedralUnsigned)
      .specialize("kOctahedral", conventions.octahedral());
  return pass.store("target", converted(graph, "normal", VK_FORMAT_R16G16B16A16_SFLOAT, normal));
}

}  // namespace

HostConstants hostConstants(const glm::mat4& projection, float exposure) {
  if (!(exposure > 0.0F && 1.0F / exposure > 0.0F)) {
    throw std::invalid_argument("the exposure is " + std::to_string(exposure) + ": it must be more than 0");
  }
  // Device depth = (z row * view position).z / depth, where z of view space is -depth: -[2][2] + [3][2] / depth.
  return {.depthFromDevice = {projection[3][2], projection[2][2]},
          .exposure = exposure,
          .inverseExposure = 1.0F / exposure};
}

DenoiserInputs addConvertInputs(fg::Graph& graph, DenoiserInputs inputs, const HostConventions& conventions,
                                fg::Buffer host) {
  if (conventions.depth != HostConventions::Depth::Linear) {
    inputs.depth = convertDepth(graph, inputs.depth, conventions.depth, host);
  }
  if (conventions.normal != HostConventions::Normal::Signed) {
    inputs.normal = convertNormal(graph, inputs.normal, conventions);
  }
  if (conventions.motionDepthReversed) {
    inputs.motion = convert(graph, "motion", shaders::convertInputMotion, inputs.motion)
                        .store("target", converted(graph, "motion", VK_FORMAT_R32G32B32A32_SFLOAT, inputs.motion));
  }
  if (conventions.preExposed) {
    fg::PassBuilder pass = convert(graph, "lighting", shaders::convertInputExposure, inputs.lighting);
    pass.uniform("hostConstants", host).specialize("kApply", false);
    inputs.lighting =
        pass.store("target", converted(graph, "lighting", VK_FORMAT_R16G16B16A16_SFLOAT, inputs.lighting));
  }
  return inputs;
}

fg::Texture addExposure(fg::Graph& graph, fg::Texture denoised, fg::Texture output, fg::Buffer host) {
  fg::PassBuilder pass = convert(graph, "result", shaders::convertInputExposure, denoised);
  pass.uniform("hostConstants", host).specialize("kApply", true);
  return pass.store("target", output);
}

}  // namespace walr
