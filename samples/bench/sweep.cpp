#include "samples/bench/sweep.h"

#include <algorithm>
#include <stdexcept>

#include "passes/settings/text.h"

namespace walr {
namespace {

/// The method and preset whose settings a sweep changes.
struct Base {
  std::string_view method;
  std::string_view preset;
};

constexpr Base kDefault{kBaseline, {}};
/// Regression at every pixel, with the settings regression.*.
constexpr Base kPerPixel{"walr_paper", "robust"};
constexpr Base kFlr{"flr", {}};
constexpr Base kSvgf{"svgf", {}};
constexpr Base kBmfr{"bmfr", {}};
constexpr Base kBilateral{"joint_bilateral", {}};

Sweep of(Base base, std::string_view name, std::string_view question, std::vector<SweepPoint> points) {
  return {name, question, base.method, base.preset, {}, std::move(points)};
}

/// A sweep over one setting's values.
Sweep over(Base base, std::string_view name, std::string_view question, std::string_view setting,
           std::initializer_list<std::string_view> values) {
  std::vector<SweepPoint> points;
  for (const std::string_view value : values) points.push_back({value, {{std::string(setting), std::string(value)}}});
  return of(base, name, question, std::move(points));
}

std::vector<Sweep> walrSweeps() {
  Sweep iterations =
      over(kPerPixel, "iterations", "How many a-trous iterations? n iterations have a window of 3^n pixels",
           "regression.iterations", {"1", "2", "3", "4", "5"});
  iterations.held = {{"walr_paper.fit-window", "off"}};
  const SettingValue kDropped = {"regression.keep-sample-count", "off"};
  Sweep remap = of(kPerPixel, "edge-range",
                   "At which distances from the plane does the edge-stopping weight begin and cease to fall?", {});
  for (const auto& [label, near, far] : {std::tuple{"quarter", "0.000375", "0.00375"},
                                         {"half", "0.00075", "0.0075"},
                                         {"default", "0.0015", "0.015"},
                                         {"double", "0.003", "0.03"},
                                         {"fourfold", "0.006", "0.06"}}) {
    remap.points.push_back({label, {{"regression.plane-near", near}, {"regression.plane-far", far}}});
  }
  return {
      iterations,
      of(kPerPixel, "parts", "How much does each part of the preset `robust` contribute?",
         {{"whole", {}},
          {"no-replacement", {{"regression.replace-taps", "off"}}},
          {"no-tracing", {{"regression.trace-edges", "off"}}},
          {"shading-normals-plane", {{"regression.plane-normal", "shading"}, {"regression.normal-factor", "off"}}},
          {"no-normal-factor", {{"regression.normal-factor", "off"}}},
          {"no-edge-leak", {{"regression.edge-leak", "0"}}},
          {"no-sample-count", {kDropped}},
          {"raw-moments", {{"regression.moments", "raw16"}, kDropped, {"regression.ridge", "2e-3"}}},
          {"no-noise-ridge", {{"regression.noise-ridge", "0"}}},
          {"floor", {{"regression.regularisation", "floor"}}},
          {"bicubic-history", {{"accumulation.history-filter", "bicubic"}}},
          {"no-diffuse-mask", {{"guides.albedo-threshold", "0"}}},
          {"no-late-history", {{"antialiasing.enabled", "off"}}}}),
      of(kPerPixel, "storage", "In which format are moments stored between iterations?",
         {{"centred16", {{"regression.moments", "centred16"}}},
          {"raw16", {{"regression.moments", "raw16"}, kDropped}},
          {"raw11", {{"regression.moments", "raw11"}, kDropped}},
          {"raw32", {{"regression.moments", "raw32"}, kDropped}}}),
      of(kPerPixel, "edges", "How much does edge tracing improve, and how much time does its distance field save?",
         {{"traced", {{"regression.trace-edges", "on"}}},
          {"traced-without-sdf", {{"regression.trace-edges", "on"}, {"regression.sdf-fraction", "0"}}},
          {"untraced", {{"regression.trace-edges", "off"}}}}),
      over(kPerPixel, "replacement", "Are taps behind edges replaced?", "regression.replace-taps",
           {"uniform", "near", "off"}),
      over(kPerPixel, "sample-count", "Is the sample count W kept through the iterations?",
           "regression.keep-sample-count", {"on", "off"}),
      over(kPerPixel, "regularisation", "Is the solution stabilised by a ridge or by a floor of the pivots?",
           "regression.regularisation", {"ridge", "floor"}),
      over(kPerPixel, "epsilon", "How large a ridge?", "regression.ridge",
           {"1e-6", "1e-5", "1e-4", "1e-3", "1e-2", "1e-1"}),
      over(kPerPixel, "noise-ridge", "How large an additional ridge for noise?", "regression.noise-ridge",
           {"0", "0.3", "1", "3", "10", "30"}),
      over(kDefault, "history", "How many frames of history before the filter?", "accumulation.max-history",
           {"1", "4", "8", "16", "32", "64"}),
      over(kDefault, "change-response", "Is history shortened where the light changes?", "accumulation.antilag",
           {"on", "off"}),
      of(kDefault, "change-score", "At how many standard errors of change is history shortened?",
         {{"2-4.3", {{"accumulation.antilag-low", "2"}, {"accumulation.antilag-high", "4.3"}}},
          {"3-6", {{"accumulation.antilag-low", "3"}, {"accumulation.antilag-high", "6"}}},
          {"4-8", {{"accumulation.antilag-low", "4"}, {"accumulation.antilag-high", "8"}}}}),
      over(kDefault, "late-history", "How many frames of history after the filter?", "antialiasing.max-history",
           {"1", "3", "5", "8", "16", "32"}),
      over(kDefault, "clipping", "At how many standard deviations from the mean is history clipped?",
           "antialiasing.clip-gamma", {"1", "2", "3", "5", "8"}),
      remap,
      over(kPerPixel, "plane-normal", "Which normal defines the plane for edge-stopping?", "regression.plane-normal",
           {"geometric", "shading"}),
      over(kDefault, "coarse-samples", "How many samples does the coarse fit count as beside the fine fit?",
           "blocks.coarse-samples", {"0", "300", "1000", "3200", "10000", "1000000"}),
      over(kDefault, "coarse-sigma", "How wide a window for the coarse fit?", "blocks.coarse-sigma",
           {"0.006", "0.012", "0.016", "0.0224", "0.032"}),
      over(kDefault, "coarse-narrowing", "How fast does the coarse fit's window narrow with the samples per pixel?",
           "blocks.coarse-narrowing", {"0", "0.3", "0.45", "0.6", "0.75"}),
      over(kDefault, "coarse-growth", "Up to which difference in light do windows of the coarse fit grow?",
           "blocks.coarse-growth-errors", {"0.001", "1", "1.6", "2", "3", "1000000"}),
      over(kDefault, "growth", "Up to which difference in light do windows of blocks grow?", "blocks.growth-errors",
           {"0.001", "3", "6", "8.5", "17", "1000000"}),
      over(kDefault, "block-size", "How large may blocks be? Small images have smaller blocks", "blocks.size",
           {"2", "3", "4", "5", "6", "8"}),
      over(kDefault, "occlusion", "How far does ambient occlusion reach?", "occlusion.radius",
           {"0.02", "0.04", "0.075", "0.15", "0.3"}),
      over(kDefault, "occlusion-rings", "How many rings of pixels does ambient occlusion look at?", "occlusion.rings",
           {"2", "3", "4", "5", "8"}),
  };
}

/// Sweeps over the parameters that the papers of the other methods leave open, and over those that Fu 2022 compares.
std::vector<Sweep> baselineSweeps() {
  Sweep singleFrame = over(kFlr, "flr-single-frame", "How wide a window for FLR if it filters frames separately?",
                           "regression.single-frame-sigma", {"8", "10", "12", "15"});
  singleFrame.held = {{"spatial-only", "on"}};
  return {
      over(kFlr, "flr-factor", "How coarse a grid for FLR's outer products?", "regression.factor",
           {"1", "2", "4", "8", "16"}),
      over(kFlr, "flr-sigma", "How wide a Gaussian window for FLR, in pixels?", "regression.sigma",
           {"3", "4", "5", "6", "7", "8", "12"}),
      over(kFlr, "flr-window", "At how many sigmas does FLR's window end?", "regression.reach", {"1", "2", "3", "4"}),
      over(kFlr, "flr-ridge", "How large a ridge for FLR?", "regression.ridge",
           {"1e-6", "1e-5", "1e-4", "1e-3", "1e-2"}),
      over(kFlr, "flr-upsampling", "How are FLR's coefficients upsampled?", "regression.upsampling",
           {"nearest", "bilinear", "bspline"}),
      of(kFlr, "flr-occlusion", "How much does ambient occlusion improve FLR, and how far does it reach?",
         {{"off", {{"regression.occlusion-guide", "off"}}},
          {"0.02", {{"occlusion.radius", "0.02"}}},
          {"0.04", {{"occlusion.radius", "0.04"}}},
          {"0.075", {{"occlusion.radius", "0.075"}}},
          {"0.15", {{"occlusion.radius", "0.15"}}}}),
      singleFrame,
      over(kFlr, "flr-history", "How many frames of history before FLR?", "accumulation.max-history",
           {"4", "8", "16", "32"}),
      of(kSvgf, "svgf-kernel", "How many taps per axis for the kernel of SVGF's iterations?",
         {{"3x3", {{"svgf.radius", "1"}}},
          {"5x5", {{"svgf.radius", "2"}}},
          {"7x7", {{"svgf.radius", "3"}}},
          {"9x9", {{"svgf.radius", "4"}}}}),
      of(kSvgf, "svgf-window",
         "SVGF's filter: a-trous iterations, the full filter that they approximate, or one small filter?",
         {{"atrous-5x5-4", {}},
          {"full-61x61", {{"svgf.window", "full"}}},
          {"plain-9x9", {{"svgf.radius", "4"}, {"svgf.iterations", "1"}}}}),
      of(kSvgf, "svgf-luminance", "How sharp a luminance weight for SVGF?",
         {{"off", {{"svgf.luminance-weight", "off"}}},
          {"1", {{"svgf.sigma-luminance", "1"}}},
          {"2", {{"svgf.sigma-luminance", "2"}}},
          {"4", {{"svgf.sigma-luminance", "4"}}},
          {"8", {{"svgf.sigma-luminance", "8"}}}}),
      over(kSvgf, "svgf-iterations", "How many iterations for SVGF?", "svgf.iterations", {"2", "3", "4", "5"}),
      over(kSvgf, "svgf-normal", "How sharp a normal weight for SVGF?", "svgf.sigma-normal",
           {"8", "16", "24", "32", "64", "128"}),
      over(kSvgf, "svgf-depth", "How far from the plane of the surface does SVGF reach?", "svgf.sigma-depth",
           {"0.005", "0.01", "0.02", "0.04", "0.08"}),
      over(kSvgf, "svgf-history", "How many frames of history before SVGF's filter?", "accumulation.max-history",
           {"5", "8", "16", "32"}),
      over(kBmfr, "bmfr-rank", "Are linearly dependent features handled by added noise or by leaving features out?",
           "fit.rank-handling", {"stochastic", "deterministic"}),
      over(kBmfr, "bmfr-noise", "How much noise on BMFR's features?", "fit.noise-amplitude",
           {"0.001", "0.003", "0.01", "0.03", "0.1"}),
      over(kBmfr, "bmfr-history", "How many frames of history before BMFR's fit?", "accumulation.max-history",
           {"3", "5", "8", "16"}),
      over(kBmfr, "bmfr-late-history", "How many fitted frames does BMFR average?", "fitted.max-history",
           {"5", "10", "20"}),
      over(kBilateral, "bilateral-radius", "How large a window for the joint bilateral filter?", "bilateral.radius",
           {"8", "12", "16", "24"}),
      over(kBilateral, "bilateral-position", "How wide a spatial Gaussian for the joint bilateral filter?",
           "bilateral.sigma-position", {"3", "4", "5", "6", "8"}),
      over(kBilateral, "bilateral-normal", "How sharp a normal weight for the joint bilateral filter?",
           "bilateral.sigma-normal", {"0.1", "0.2", "0.4", "0.8"}),
      over(kBilateral, "bilateral-plane", "How sharp a plane weight for the joint bilateral filter?",
           "bilateral.sigma-plane", {"0.05", "0.1", "0.2", "0.4"}),
      over(kBilateral, "bilateral-colour", "How sharp a colour weight for the joint bilateral filter?",
           "bilateral.sigma-colour", {"4", "10", "30", "inf"}),
      over(kBilateral, "bilateral-clipping",
           "At how many standard deviations is the joint bilateral filter's history clipped?",
           "antialiasing.clip-gamma", {"1", "2", "4", "8", "16"}),
  };
}

std::vector<Sweep> makeSweeps() {
  std::vector<Sweep> all = walrSweeps();
  for (Sweep& sweep : baselineSweeps()) all.push_back(std::move(sweep));
  return all;
}

/// The sweep of this name; null if there is none.
const Sweep* find(std::string_view name) {
  const auto found = std::ranges::find(sweeps(), name, &Sweep::name);
  return found == sweeps().end() ? nullptr : &*found;
}

}  // namespace

std::span<const Sweep> sweeps() {
  static const std::vector<Sweep> all = makeSweeps();
  return all;
}

std::vector<Variant> sweepVariants(std::string_view name) {
  const Sweep* sweep = find(name);
  if (sweep == nullptr) {
    std::vector<std::string_view> names;
    for (const Sweep& known : sweeps()) names.push_back(known.name);
    throw std::invalid_argument("there is no sweep \"" + std::string(name) + "\"; known sweeps: " + join(names));
  }
  std::vector<Variant> variants;
  for (const SweepPoint& point : sweep->points) {
    Variant variant{.name = std::string(name) + "=" + std::string(point.label),
                    .method = std::string(sweep->method),
                    .preset = std::string(sweep->preset),
                    .settings = sweep->held,
                    .sweep = std::string(name)};
    variant.settings.insert(variant.settings.end(), point.settings.begin(), point.settings.end());
    variants.push_back(std::move(variant));
  }
  return variants;
}

bool isDefault(const Variant& variant) {
  Variant untouched{
      .name = {}, .method = variant.method, .preset = variant.preset, .settings = {}, .sweep = variant.sweep};
  if (const Sweep* sweep = find(variant.sweep)) untouched.settings = sweep->held;
  return settingsOf(untouched) == settingsOf(variant);
}

}  // namespace walr
