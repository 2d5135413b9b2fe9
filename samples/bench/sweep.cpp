#include "samples/bench/sweep.h"

#include <algorithm>
#include <stdexcept>

#include "passes/text.h"

namespace walr {
namespace {

/// The preset that regresses at every pixel, with the settings regression.*.
constexpr std::string_view kPerPixel = "robust";

/// A sweep over one setting's values.
Sweep over(std::string_view name, std::string_view question, std::string_view setting,
           std::initializer_list<std::string_view> values) {
  const bool perPixel = setting.starts_with("regression.");
  Sweep sweep{name, question, perPixel ? kPerPixel : std::string_view{}, {}};
  for (const std::string_view value : values) {
    sweep.points.push_back({value, {{std::string(setting), std::string(value)}}});
  }
  return sweep;
}

std::vector<Sweep> makeSweeps() {
  Sweep iterations{"iterations", "How many a-trous iterations, at 3^n pixels of window?", kPerPixel, {}};
  for (const std::string_view n : {"1", "2", "3", "4", "5"}) {
    iterations.points.push_back({n, {{"walr.fit-window", "off"}, {"regression.iterations", std::string(n)}}});
  }
  const SettingValue kDropped = {"regression.keep-sample-count", "off"};
  Sweep remap{"edge-range", "How far from the plane does an edge begin and end?", kPerPixel, {}};
  for (const auto& [label, near, far] : {std::tuple{"quarter", "0.000375", "0.00375"},
                                         {"half", "0.00075", "0.0075"},
                                         {"default", "0.0015", "0.015"},
                                         {"double", "0.003", "0.03"},
                                         {"fourfold", "0.006", "0.06"}}) {
    remap.points.push_back({label, {{"regression.plane-near", near}, {"regression.plane-far", far}}});
  }
  return {
      iterations,
      {"storage",
       "How must the moments be stored between iterations?",
       kPerPixel,
       {{"centred16", {{"regression.moments", "centred16"}}},
        {"raw16", {{"regression.moments", "raw16"}, kDropped}},
        {"raw11", {{"regression.moments", "raw11"}, kDropped}},
        {"raw32", {{"regression.moments", "raw32"}, kDropped}}}},
      {"edges",
       "What does edge tracing buy, and its distance field save?",
       kPerPixel,
       {{"traced", {{"regression.trace-edges", "on"}}},
        {"traced-without-sdf", {{"regression.trace-edges", "on"}, {"regression.sdf-fraction", "0"}}},
        {"untraced", {{"regression.trace-edges", "off"}}}}},
      over("filter", "Regress on every pixel, or on blocks of pixels?", "walr.filter", {"pixels", "blocks"}),
      over("replacement", "Replace taps behind edges?", "regression.replace-taps", {"uniform", "near", "off"}),
      over("sample-count", "Carry the sample count W through the iterations?", "regression.keep-sample-count",
           {"on", "off"}),
      over("regularisation", "A ridge, or floored pivots?", "regression.regularisation", {"ridge", "floor"}),
      over("epsilon", "How large a ridge?", "regression.ridge", {"1e-6", "1e-5", "1e-4", "1e-3", "1e-2", "1e-1"}),
      over("noise-ridge", "How much further ridge for noise?", "regression.noise-ridge", {"0", "1", "3", "10", "30"}),
      over("history", "How many samples before the filter?", "accumulation.max-samples",
           {"1", "4", "8", "16", "32", "64"}),
      over("late-history", "How many frames after the filter?", "antialiasing.max-samples",
           {"1", "4", "8", "16", "32"}),
      over("clipping", "How tight a box of variance clipping?", "antialiasing.clip-gamma", {"0.5", "1", "2", "4"}),
      over("history-filter", "How is history read between pixels?", "accumulation.history-filter",
           {"bilinear", "bicubic"}),
      remap,
      over("plane-normal", "Which normal spans the plane of an edge?", "regression.plane-normal",
           {"geometric", "shading"}),
      over("coarse-samples", "How much does the coarse fit count beside a block's own?", "blocks.coarse-samples",
           {"0", "30", "100", "300", "1000", "1000000"}),
      over("coarse-sigma", "How wide a window for the coarse fit?", "blocks.coarse-sigma",
           {"0.014", "0.02", "0.028", "0.04", "0.056"}),
      over("occlusion", "How far does ambient occlusion look?", "occlusion.radius",
           {"0.02", "0.04", "0.075", "0.15", "0.3"}),
  };
}

}  // namespace

std::span<const Sweep> sweeps() {
  static const std::vector<Sweep> all = makeSweeps();
  return all;
}

std::vector<Variant> sweepVariants(std::string_view name) {
  const auto found = std::ranges::find(sweeps(), name, &Sweep::name);
  if (found == sweeps().end()) {
    std::vector<std::string_view> names;
    for (const Sweep& sweep : sweeps()) names.push_back(sweep.name);
    throw std::invalid_argument("there is no sweep \"" + std::string(name) + "\"; known sweeps: " + join(names));
  }
  std::vector<Variant> variants;
  for (const SweepPoint& point : found->points) {
    variants.push_back({.name = std::string(name) + "=" + std::string(point.label),
                        .method = std::string(kBaseline),
                        .preset = std::string(found->preset),
                        .settings = point.settings,
                        .sweep = std::string(name)});
  }
  return variants;
}

}  // namespace walr
