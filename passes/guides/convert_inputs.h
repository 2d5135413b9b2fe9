#pragma once

#include <array>
#include <cstdint>

#include <glm/mat4x4.hpp>

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "passes/stage/stage_graph.h"
#include "shaders/guides/convert_input.h"

namespace walr {

/// Formats of a result that a host may choose; methods write the first.
inline constexpr std::array kResultFormats{VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_B10G11R11_UFLOAT_PACK32,
                                           VK_FORMAT_R32G32B32A32_SFLOAT};

/// How a host writes its textures, if not as `DenoiserInputs` says. Each texture that differs costs one pass; the
/// others cost nothing.
struct HostConventions {
  enum class Depth : std::uint8_t {
    Linear,          ///< Linear view depth, positive.
    NegativeLinear,  ///< z of view space.
    /// z of Vulkan's clip space over w, as the projection matrix makes it: 0 near or far, finite or infinite.
    Device,
  };
  enum class Normal : std::uint8_t {
    Signed,              ///< Three channels in -1..1.
    Unsigned,            ///< Three channels in 0..1 that stand for -1..1; all zero is sky.
    OctahedralSigned,    ///< Octahedral map with its pole on +z, two channels in -1..1 (Cigolle et al. 2014).
                         ///< Sky is told by depth alone.
    OctahedralUnsigned,  ///< The same in 0..1.
  };
  Depth depth = Depth::Linear;
  Normal normal = Normal::Signed;
  bool motionDepthReversed = false;  ///< motion.z is current minus previous view depth.
  bool preExposed = false;           ///< Lighting is multiplied by a changing exposure, and so is the result.
  /// Only a rectangle of the textures, the result's included, is denoised. It starts at `HostConstants::offset`.
  bool rectangle = false;
  /// The camera is orthographic (orthographic.h): depth is moved to that of the stand-in. Motion depth of a
  /// static scene is refused, and its inputs cannot be checked for faults.
  bool orthographic = false;
  /// Of the result's texture: one of `kResultFormats`.
  VkFormat result = kResultFormats.front();

  [[nodiscard]] bool octahedral() const {
    return normal == Normal::OctahedralSigned || normal == Normal::OctahedralUnsigned;
  }
  /// Whether anything differs from the project's conventions, the result included: then `HostConstants` are needed.
  [[nodiscard]] bool differs() const {
    return depth != Depth::Linear || normal != Normal::Signed || motionDepthReversed || orthographic ||
           convertsResult();
  }
  [[nodiscard]] bool convertsResult() const { return preExposed || rectangle || result != kResultFormats.front(); }
};

/// The uniform block of the conversion.
/// @param projection view to clip space, with the z row that makes the host's device depth; it may be orthographic
/// @param exposure   above 0
/// @param offset     see `HostConventions::rectangle`
/// @throws std::invalid_argument if the exposure is not above 0
HostConstants hostConstants(const glm::mat4& projection, float exposure, glm::ivec2 offset = {});

/// Convert the inputs that differ from the project's conventions.
/// @param inputs as the host writes them
/// @param host   upload of `HostConstants`; not used if `differs()` is false
/// @returns inputs by the project's conventions
DenoiserInputs addConvertInputs(StageGraph graph, DenoiserInputs inputs, const HostConventions& conventions,
                                fg::Buffer host);

/// The same for a light that has the guides in common with another: convert its lighting and confidence only.
/// @param inputs the other light's converted inputs, with this light's lighting and confidence
DenoiserInputs addConvertLight(StageGraph graph, DenoiserInputs inputs, const HostConventions& conventions,
                               fg::Buffer host);

/// Multiply the result by the exposure of the frame and write it to its place, rounded to the nearest value of its
/// format.
/// @param denoised RGBA16F
/// @param output   texture to write to, of one of `kResultFormats`
/// @returns the output's new version
fg::Texture addConvertResult(StageGraph graph, fg::Texture denoised, fg::Texture output, fg::Buffer host);

}  // namespace walr
