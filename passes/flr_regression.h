#pragma once

#include <cstdint>

#include "framegraph/graph.h"
#include "passes/lighting_alpha.h"
#include "passes/prepare_guides.h"
#include "passes/settings.h"

namespace walr {

/// Settings of the local regression. The poster gives none of them.
struct FlrRegressionSettings {
  std::uint32_t factor = 4;
  float sigma = 6.0F;
  float reach = 3.0F;
  float ridge = 1e-4F;

  void visit(SettingVisitor& v) {
    v.visit({"regression.factor", "Pixels per axis whose outer products are summed into one cell", "pixels", 1, 32,
             "measured"},
            factor);
    v.visit({"regression.sigma", "Standard deviation of the Gaussian window", "pixels", 0.1, 256.0, "measured"}, sigma);
    v.visit({"regression.reach", "Distance at which the Gaussian window ends", "sigma", 1.0, 6.0, "measured"}, reach);
    v.visit({"regression.ridge",
             "Added to the diagonal of the covariance of the normal, and relative to its squared mean to that of the "
             "inverse depth",
             "", 1e-6, 1.0, "measured"},
            ridge);
  }
};

/// Weighted least squares of the lighting on {1, normal, inverse depth} in a Gaussian window around every cell of a
/// coarse grid; the coefficients, interpolated, are applied to the guides of every pixel (flr-flnr.txt).
/// @param lighting RGBA16F: radiance to filter; a pixel that is not finite has no say in the fit
/// @param alpha    what the alpha channel of `lighting` says; a pixel with no sample has no say in the fit
/// @param output   RGBA16F texture to write the result to
/// @returns the output's new version; sky and pixels without a diffuse lobe as they were
/// @throws std::invalid_argument where the moments of so many cells do not fit a storage buffer
fg::Texture addFlrRegression(fg::Graph& graph, fg::Texture lighting, LightingAlpha alpha, const Guides& guides,
                             fg::Texture output, const FlrRegressionSettings& settings = {});

}  // namespace walr
