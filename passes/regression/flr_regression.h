#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "framegraph/declare/graph.h"
#include "passes/conventions/lighting_alpha.h"
#include "passes/guides/prepare_guides.h"
#include "passes/settings/settings.h"
#include "passes/stage/stage_graph.h"

namespace walr {

/// How the coefficients of cells are interpolated at pixels.
enum class FlrUpsampling : std::uint32_t {
  Nearest,   ///< Of the pixel's own cell.
  Bilinear,  ///< Of the four cells around it.
  Bspline,   ///< Of the sixteen around it, by the cubic B-spline.
};

/// Settings of the local regression. The poster gives none of them.
struct FlrRegressionSettings {
  std::uint32_t factor = 4;
  float sigma = 6.0F;
  float reach = 3.0F;
  float ridge = 1e-4F;
  FlrUpsampling upsampling = FlrUpsampling::Bilinear;
  bool occlusionGuide = true;

  void visit(SettingVisitor& v) {
    visitFit(v);
    v.visit({"regression.occlusion-guide", "Take ambient occlusion among the guides", "", 0, 1,
             "Salmi et al. 2024: optional"},
            occlusionGuide);
  }
  /// All but the choice of guides.
  void visitFit(SettingVisitor& v) {
    static constexpr std::array<std::string_view, 3> kUpsamplings{"nearest", "bilinear", "bspline"};
    v.visit({"regression.factor", "Pixels per axis whose outer products are summed into one cell", "pixels", 1, 32,
             "measured"},
            factor);
    v.visit({"regression.sigma", "Standard deviation of the Gaussian window", "pixels", 0.1, 256.0, "measured"}, sigma);
    v.visit({"regression.reach", "Distance at which the Gaussian window ends", "sigma", 1.0, 6.0, "measured"}, reach);
    v.visit({"regression.ridge",
             "Ridge on the diagonal of the covariance of the guides; for inverse depth relative to its squared mean",
             "", 1e-6, 1.0, "measured"},
            ridge);
    v.visitEnum(
        {"regression.upsampling", "How the cells' coefficients are interpolated at a pixel", "", 0, 1, "measured"},
        kUpsamplings, upsampling);
  }
};

/// Guides that a network made, in 0..1 and of the picture's extent; none, unless `first` is valid.
struct LearnedGuides {
  fg::Texture first;  ///< RGBA16F: three guides, or four if there is `more`.
  fg::Texture more;   ///< RGBA16F: a fifth guide in red; or not valid.

  [[nodiscard]] bool valid() const { return first.valid(); }
  /// Three guides stand beside the geometric ones, five in their place.
  [[nodiscard]] bool alone() const { return more.valid(); }
};

/// Weighted least squares of the lighting on {1, normal, inverse depth, ambient occlusion} in a Gaussian window around
/// every cell of a coarse grid; the coefficients, interpolated, are applied to the guides of every pixel
/// (Salmi et al. 2024).
/// @param lighting  RGBA16F: radiance to filter; pixels that are not finite do not count
/// @param alpha     what the alpha channel of `lighting` holds; pixels without samples do not count
/// @param guides    with `features` where `settings.occlusionGuide` is set
/// @param output    RGBA16F texture to write the result to
/// @param learned   more guides (`addGuideNetwork`), with `settings.occlusionGuide`
/// @returns the output's new version; sky and pixels without a diffuse lobe hold the pass-through
/// @throws std::invalid_argument if the moments of all cells do not fit one storage buffer
fg::Texture addFlrRegression(StageGraph graph, fg::Texture lighting, LightingAlpha alpha, const Guides& guides,
                             fg::Texture output, const FlrRegressionSettings& settings = {},
                             const LearnedGuides& learned = {});

}  // namespace walr
