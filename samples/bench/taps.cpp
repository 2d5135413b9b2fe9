#include "samples/bench/taps.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include "shaders/constants/flr.h"

namespace walr {
namespace {

constexpr double kBilinear = 4.0;
constexpr double kBicubic = 16.0;

std::uint32_t constantOf(const fg::ComputeDispatch& work, std::string_view name) {
  const auto constants = work.shader->constants;
  const auto found = std::ranges::find(constants, name, &fg::ShaderConstant::name);
  return work.specialization.at(static_cast<std::size_t>(found - constants.begin()));
}

double window(std::uint32_t radius) {
  return (2.0 * radius + 1.0) * (2.0 * radius + 1.0);
}

/// The FLR stages' push constants, and the number of cells in the image as a share of its pixels.
FlrConstants flrConstants(const fg::ComputeDispatch& work) {
  FlrConstants constants{};
  std::memcpy(&constants, work.constants.data(), sizeof(constants));
  return constants;
}

double flrCells(const fg::ComputeDispatch& work, fg::Extent extent) {
  const FlrConstants constants = flrConstants(work);
  return static_cast<double>(constants.cells.x) * constants.cells.y / extent.width / extent.height;
}

double flrLine(const fg::ComputeDispatch& work, fg::Extent extent) {
  return (2.0 * flrConstants(work).radius + 1.0) * flrCells(work, extent);
}

/// Taps a pixel of a shader by the stem of its name.
struct ShaderTaps {
  std::string_view shader;
  double (*taps)(const fg::ComputeDispatch& work, fg::Extent extent);
};

constexpr std::array kShaders = {
    ShaderTaps{"pass_through", [](const fg::ComputeDispatch&, fg::Extent) { return 1.0; }},
    ShaderTaps{"prepare_guides", [](const fg::ComputeDispatch&, fg::Extent) { return 0.0; }},
    ShaderTaps{"temporal_accumulation",
               [](const fg::ComputeDispatch& work, fg::Extent) {
                 return 1.0 + (constantOf(work, "kBicubicHistory") != 0 ? kBicubic : kBilinear);
               }},
    ShaderTaps{"temporal_antialiasing",
               [](const fg::ComputeDispatch& work, fg::Extent) {
                 return kBicubic + 1.0 + window(constantOf(work, "kClipRadius"));
               }},
    ShaderTaps{"atrous", [](const fg::ComputeDispatch&, fg::Extent) { return 9.0; }},
    ShaderTaps{"svgf_accumulation", [](const fg::ComputeDispatch&, fg::Extent) { return 1.0 + 2.0 * kBilinear; }},
    ShaderTaps{"svgf_variance", [](const fg::ComputeDispatch&, fg::Extent) { return window(3); }},
    // A 3 x 3 blur of the variance beside the window.
    ShaderTaps{"svgf_atrous",
               [](const fg::ComputeDispatch& work, fg::Extent) { return 9.0 + window(constantOf(work, "kRadius")); }},
    ShaderTaps{"bmfr_fit", [](const fg::ComputeDispatch&, fg::Extent) { return 1.0; }},
    ShaderTaps{"bmfr_accumulation", [](const fg::ComputeDispatch&, fg::Extent) { return 1.0 + kBilinear; }},
    ShaderTaps{"flr_moments", [](const fg::ComputeDispatch&, fg::Extent) { return 1.0; }},
    ShaderTaps{"flr_blur", flrLine},
    ShaderTaps{"flr_solve", flrLine},
    ShaderTaps{"flr_apply", [](const fg::ComputeDispatch&, fg::Extent) { return kBilinear; }},
    ShaderTaps{"joint_bilateral",
               [](const fg::ComputeDispatch& work, fg::Extent) { return window(constantOf(work, "kRadius")); }},
};

}  // namespace

std::optional<double> tapsPerPixel(const fg::GraphDesc& graph, const fg::Plan& plan, fg::Extent extent) {
  double taps = 0.0;
  for (const fg::PlannedPass& planned : plan.passes) {
    const auto* work = std::get_if<fg::ComputeDispatch>(&graph.passes[planned.pass].work);
    if (work == nullptr || work->shader == nullptr) return std::nullopt;
    const std::string_view name = work->shader->name.substr(0, work->shader->name.find('.'));
    const auto found = std::ranges::find(kShaders, name, &ShaderTaps::shader);
    if (found == kShaders.end()) return std::nullopt;
    taps += found->taps(*work, extent);
  }
  return taps;
}

}  // namespace walr
