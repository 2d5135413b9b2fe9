#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "framegraph/declare/graph.h"
#include "passes/guides/prepare_guides.h"
#include "passes/settings/settings.h"
#include "passes/stage/stage_graph.h"
#include "passes/temporal/svgf_accumulation.h"

namespace walr {

/// The spatial filter.
enum class SvgfWindow : std::uint32_t {
  Atrous,  ///< A-trous iterations.
  Full,    ///< One bilateral filter over the iterations' whole reach, with a Gaussian of equal variance.
};

/// Settings of SVGF's variance estimation and a-trous iterations.
struct SvgfFilterSettings {
  SvgfWindow window = SvgfWindow::Atrous;
  std::uint32_t iterations = 4;
  std::uint32_t radius = 2;
  float sigmaDepth = 0.02F;
  float sigmaNormal = 24.0F;
  bool luminanceWeight = true;
  float sigmaLuminance = 4.0F;
  float minHistory = 4.0F;
  float lobeShare = 0.7F;
  std::uint32_t feedback = 0;

  void visit(SettingVisitor& v) {
    static constexpr std::array<std::string_view, 2> kWindows{"atrous", "full"};
    v.visitEnum({"svgf.window",
                 "A-trous iterations, or one bilateral filter over all pixels that they reach: what they approximate",
                 "", 0, 1, "Fu 2022"},
                kWindows, window);
    v.visit({"svgf.iterations", "A-trous iterations with taps 2^i pixels apart", "", 1, 8,
             "Fu 2022: 4; Schied et al. 2017: 5"},
            iterations);
    v.visit({"svgf.radius", "Taps on each side of the centre; 1, 2, 3, 4 are kernels of 3x3, 5x5, 7x7, 9x9", "taps", 1,
             4, "Fu 2022"},
            radius);
    v.visit({"svgf.sigma-depth", "Distance from the tangent plane at which a pixel weighs 1/e", "fraction of depth",
             1e-6, 1e6, "measured"},
            sigmaDepth);
    v.visit({"svgf.sigma-normal", "Exponent of the cosine between normals; 0 weighs all normals alike", "", 0.0, 1e4,
             "Schied et al. 2017, 4.4: 128; Fu 2022: 64"},
            sigmaNormal);
    v.visit({"svgf.luminance-weight", "Stop at edges of the luminance that its variance does not explain", "", 0, 1,
             "Fu 2022"},
            luminanceWeight);
    v.visit({"svgf.sigma-luminance", "Luminance difference at which a pixel weighs 1/e", "standard deviations", 1e-6,
             1e6, "Schied et al. 2017, 4.4; Fu 2022: 4"},
            sigmaLuminance);
    v.visit({"svgf.min-history", "Samples below which the variance is estimated over 7x7 pixels", "frames", 0.0, 256.0,
             "Schied et al. 2017, 4.2"},
            minHistory);
    v.visit(
        {"svgf.lobe-share", "Part of the lobe's half angle at which a pixel weighs exp(-1/2); 0: normals weigh alone",
         "", 0.0, 10.0, "measured", kSpecularLight},
        lobeShare);
    v.visit({"svgf.feedback", "Iterations whose result is the next frame's colour history; at most all of them", "", 0,
             8, "Schied et al. 2017, 4.3: 1"},
            feedback);
  }
};

/// Add the standard deviation of the luminance to the colour.
/// @returns RGBA16F: radiance; alpha: standard deviation, negative where there is no sample
fg::Texture addSvgfVariance(StageGraph graph, fg::Buffer frame, const SvgfAccumulated& accumulated,
                            const Guides& guides, const SvgfFilterSettings& settings = {});

/// The same for a single frame, from the spatial estimate alone.
/// @param lighting RGBA16F: noisy radiance
fg::Texture addSvgfSingleFrameVariance(StageGraph graph, fg::Buffer frame, fg::Texture lighting, const Guides& guides,
                                       const SvgfFilterSettings& settings = {});

/// Edge-avoiding a-trous iterations guided by variance, or the bilateral filter that they approximate.
/// @param colour   RGBA16F: radiance and standard deviation, from one of the above
/// @param lobes    `SvgfAccumulated::lobes`, or not valid; they weigh in place of normals unless `settings.lobeShare`
/// is 0
/// @param feedback RGBA16F texture for the result of iteration number `settings.feedback`, counted from 1
/// @returns RGBA16F: filtered radiance and its standard deviation; sky and pixels without a diffuse lobe hold the
/// pass-through
/// @throws std::invalid_argument where `settings.feedback` exceeds the number of iterations, or where the iterations
///         reach too far for a full window
fg::Texture addSvgfAtrous(StageGraph graph, fg::Buffer frame, fg::Texture colour, const Guides& guides,
                          fg::Texture lobes, fg::Texture feedback, const SvgfFilterSettings& settings = {});

}  // namespace walr
