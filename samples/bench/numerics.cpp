#include "samples/bench/numerics.h"

#include <array>
#include <cmath>
#include <utility>

#include "samples/bench/hard_case_scenes.h"
#include "samples/denoise/gpu_denoiser.h"
#include "samples/metrics/metrics.h"

namespace walr {
namespace {

constexpr std::array kStorages = {"centred16", "raw16", "raw11", "raw32"};
constexpr std::array kRegularisations = {"ridge", "floor"};
constexpr std::array kEpsilons = {"1e-6", "1e-5", "1e-4", "1e-3", "1e-2"};

Variant spatialOnly(const NumericsSetting& setting) {
  Variant variant;
  variant.method = "walr_paper";
  variant.preset = "robust";  // Its regression supports every storage and solver.
  variant.settings = {{"walr_paper.fit-window", "off"},
                      {"regression.iterations", "3"},
                      {"accumulation.max-history", "1"},
                      {"antialiasing.max-history", "1"},
                      {"regression.moments", setting.storage},
                      {"regression.keep-sample-count", setting.storage == "centred16" ? "on" : "off"},
                      {"regression.regularisation", setting.regularisation},
                      {"regression.ridge", setting.epsilon}};
  return variant;
}

HardCaseErrors judge(DenoisedPicture picture, const HardCase& hardCase) {
  HardCaseErrors judged;
  judged.hardCase = hardCase.name;
  judged.counters = std::move(picture.counters);
  const Image& result = picture.lights.front();
  double squares = 0.0;
  double truthSquares = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < hardCase.counted.size(); ++i) {
    for (std::size_t c = 0; hardCase.counted[i] != 0 && c < 3; ++c) {
      const double value = result.pixel(i)[c];
      const double truth = hardCase.truth.pixel(i)[c];
      judged.negativeOut += value < 0.0 ? 1 : 0;
      if (!std::isfinite(value)) continue;
      squares += (value - truth) * (value - truth);
      truthSquares += truth * truth;
      count += 1.0;
    }
  }
  judged.nonFiniteIn = countNonFinite(hardCase.packed.frame.indirect);
  judged.nonFiniteOut = countNonFinite(result);
  judged.error = std::sqrt(squares / (truthSquares > 0.0 ? truthSquares : count));
  return judged;
}

/// A denoiser for the size of the hard cases, with counters.
GpuDenoiser makeGpuDenoiser(const GpuDevice& device, const Variant& variant) {
  return {device, *makeVariant(variant), kHardCaseExtent, projectLayout(), {.views = {}, .counters = true}};
}

}  // namespace

std::vector<NumericsSetting> numericsSettings() {
  std::vector<NumericsSetting> settings;
  for (const char* storage : kStorages) {
    for (const char* regularisation : kRegularisations) {
      for (const char* epsilon : kEpsilons) settings.push_back({storage, regularisation, epsilon});
    }
  }
  return settings;
}

std::vector<NumericsResult> numerics(const GpuDevice& device, std::span<const NumericsSetting> settings) {
  const std::vector<HardCase> cases = hardCases();
  std::vector<NumericsResult> results;
  for (const NumericsSetting& setting : settings) {
    GpuDenoiser denoiser = makeGpuDenoiser(device, spatialOnly(setting));
    for (const HardCase& hardCase : cases) {
      results.push_back({judge(denoiser.run(hardCase.packed), hardCase), setting});
    }
  }
  return results;
}

std::vector<MethodHardCase> methodHardCases(const GpuDevice& device, std::span<const Variant> variants) {
  const std::vector<HardCase> cases = hardCases();
  std::vector<MethodHardCase> results;
  for (const Variant& variant : variants) {
    GpuDenoiser denoiser = makeGpuDenoiser(device, variant);
    for (const HardCase& hardCase : cases) {
      results.push_back({judge(denoiser.run(hardCase.packed), hardCase), variant.name});
    }
  }
  return results;
}

}  // namespace walr
