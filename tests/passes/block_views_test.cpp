// Views of the regression over blocks: that they fit together to what the filter makes of them.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "passes/ambient_occlusion.h"
#include "passes/block_regression.h"
#include "tests/passes/comparison.h"
#include "tests/passes/host_textures.h"
#include "tests/passes/reference/block_regression.h"
#include "tests/passes/reference/octahedral.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test {
namespace {

using reference::HostFrame;
using reference::Image;

constexpr glm::ivec2 kSize(45, 34);  // No multiple of a block.

/// The regression alone, with its views.
class ViewedRegression {
 public:
  ViewedRegression(const fg::vk::Device& device, const BlockRegressionSettings& settings,
                   const std::vector<std::string>& views)
      : frame_(graph_.upload("frame constants", sizeof(FrameConstants))),
        guides_(importGuides(graph_, kSize)),
        accumulated_(importHalves(graph_, "accumulated", kSize)),
        occlusion_(importHalves(graph_, "occlusion", kSize)) {
    const fg::Extent extent{static_cast<std::uint32_t>(kSize.x), static_cast<std::uint32_t>(kSize.y)};
    Inspection inspection;
    for (const std::string& view : views)
      inspection.want(view, graph_.import("view of " + view, {kViewFormat, extent}, fg::vk::kOverwritable));
    output_ = copyOut(graph_, "result",
                      addBlockRegression(graph_, frame_, accumulated_, LightingAlpha::SampleCount, guides_, occlusion_,
                                         settings, &inspection));
    inspection.requireViews();
    for (const DebugView& view : inspection.views()) {
      graph_.exported(view.texture, fg::vk::kReadable);
      views_[view.name] = view.texture;
    }
    run_ = std::make_unique<fg::test::GraphRun>(device, graph_);
  }

  void filter(const HostFrame& frame, const Image<reference::Guide>& guides, const Image<glm::dvec4>& accumulated,
              const Image<double>& occlusion) {
    Image<glm::dvec4> wide(kSize);
    reference::forEachPixel(kSize, [&](glm::ivec2 p) { wide[p].x = occlusion[p]; });
    run_->executor().upload(frame_, frame.constants);
    upload(*run_, guides_, guides);
    upload(*run_, accumulated_, accumulated);
    upload(*run_, occlusion_, wide);
    run_->frame();
  }
  [[nodiscard]] Image<glm::dvec4> output() const { return readHalves(*run_, output_, kSize); }
  [[nodiscard]] Image<glm::dvec3> view(const std::string& name) const {
    const std::vector<float> texels = run_->texels<float>(views_.at(name));
    Image<glm::dvec3> image(kSize);
    for (std::size_t i = 0; i < image.pixels().size(); ++i)
      image.pixels()[i] = {texels[4 * i], texels[4 * i + 1], texels[4 * i + 2]};
    return image;
  }

 private:
  fg::Graph graph_;
  fg::Buffer frame_;
  Guides guides_;
  fg::Texture accumulated_;
  fg::Texture occlusion_;
  fg::Texture output_;
  std::map<std::string, fg::Texture> views_;
  std::unique_ptr<fg::test::GraphRun> run_;
};

/// A frame as the regression takes it.
struct Inputs {
  HostFrame frame;
  Image<reference::Guide> guides;
  Image<glm::dvec4> accumulated;
  Image<double> occlusion;
};
Inputs inputsOf(const Scene& scene) {
  Inputs inputs;
  inputs.frame = renderStill(scene, kSize);
  inputs.guides = reference::prepareGuides(inputs.frame, reference::Storage::Quantised);
  inputs.accumulated = withAlpha(inputs.frame.lighting);
  for (glm::dvec4& sample : inputs.accumulated.pixels()) sample.a = 1.0;
  inputs.occlusion = reference::ambientOcclusion(inputs.frame, inputs.guides, 8.0);
  for (double& o : inputs.occlusion.pixels()) o = reference::roundToHalf(o);
  return inputs;
}

/// Largest relative error of a block's moments, which are stored as halves once before the iteration.
constexpr double kStored = 2.0 * reference::kHalfRoundoff;

// Values of a sample, by number: the normal, ambient occlusion, the colour.
constexpr int kOcclusion = 3;
constexpr int kColour = 4;
constexpr int kValues = 7;

/// Moments of 6x6 pixels, and what storing those of their blocks may add to them.
class Window {
 public:
  Window(const Inputs& in, glm::ivec2 first) {
    for (int k = 0; k < kCount; ++k) {
      const glm::ivec2 q = first + glm::ivec2(k % 6, k / 6);
      const glm::dvec3 n = reference::octahedralDecode(in.guides[q].features);
      const glm::dvec4 y = in.accumulated[q];
      samples_[k] = {n.x, n.y, n.z, in.occlusion[q], y.r, y.g, y.b};
    }
    for (int i = 0; i < kValues; ++i) {
      for (const auto& sample : samples_) {
        mean_[i] += sample[i] / kCount;
        size_[i] = std::max(size_[i], std::abs(sample[i]));
      }
      for (const auto& sample : samples_) spread_[i] = std::max(spread_[i], std::abs(sample[i] - mean_[i]));
    }
  }
  [[nodiscard]] double mean(int i) const { return mean_[i]; }
  [[nodiscard]] double meanTolerance(int i) const { return (kStored + kArithmetic) * size_[i]; }
  [[nodiscard]] double covariance(int i, int j) const {
    double sum = 0.0;
    for (const auto& sample : samples_) sum += (sample[i] - mean_[i]) * (sample[j] - mean_[j]) / kCount;
    return sum;
  }
  /// The blocks' covariances, no larger than the product of the spreads, are rounded, and so are the means whose spread
  /// about the window's mean comes on top.
  [[nodiscard]] double covarianceTolerance(int i, int j) const {
    const double stored = spread_[i] * spread_[j] + size_[i] * spread_[j] + spread_[i] * size_[j];
    return kStored * stored + kArithmetic * size_[i] * size_[j];
  }

 private:
  static constexpr int kCount = 36;
  static constexpr double kArithmetic = 64.0 * reference::kFloatRoundoff;  // Some sums of some tens of terms.
  std::array<std::array<double, kValues>, kCount> samples_{};
  std::array<double, kValues> mean_{};
  std::array<double, kValues> size_{};
  std::array<double, kValues> spread_{};
};

class BlockViewsTest : public fg::test::GpuTest {};

// The output is the mixture of the two fits in the share that the samples give them.
TEST_F(BlockViewsTest, TheMixtureIsTheOutput) {
  const BlockRegressionSettings settings{.size = 2, .iterations = 2};
  ViewedRegression run(device(), settings, {"samples", "occlusion", "fine-fit", "coarse-fit", "few-samples"});
  for (const NamedScene& named : allScenes()) {
    SCOPED_TRACE(named.name);
    const Inputs in = inputsOf(named.scene);
    run.filter(in.frame, in.guides, in.accumulated, in.occlusion);
    const Image<glm::dvec4> output = run.output();
    const Image<glm::dvec3> samples = run.view("samples");
    const Image<glm::dvec3> occlusion = run.view("occlusion");
    const Image<glm::dvec3> fine = run.view("fine-fit");
    const Image<glm::dvec3> coarse = run.view("coarse-fit");
    const Image<glm::dvec3> few = run.view("few-samples");
    const Image<glm::dvec3>* const views[] = {&samples, &occlusion, &fine, &few};
    Comparison comparison("mixture");
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      if (in.guides[p].depth == 0.0) {
        for (const Image<glm::dvec3>* view : views) EXPECT_EQ((*view)[p], glm::dvec3(0.0));
        return;
      }
      comparison.compared();
      const double w = samples[p].x;
      const double k = settings.coarseSamples;
      const double share = samples[p].y;
      comparison.value(p, "share", share, k / (w + k), 8.0 * reference::kFloatRoundoff);
      comparison.value(p, "unfitted", samples[p].z, 0.0, 0.0);
      comparison.value(p, "occlusion", occlusion[p].x, in.occlusion[p], 0.0);
      comparison.value(p, "few", few[p].x, w < 6.0 ? 1.0 : 0.0, 0.0);
      comparison.value(p, "mostly coarse", few[p].y, 1.0 - share < 0.5 ? 1.0 : 0.0, 0.0);
      comparison.value(p, "unsampled", few[p].z, 0.0, 0.0);
      for (int c = 0; c < 3; ++c) {
        const double expected = share * coarse[p][c] + (1.0 - share) * fine[p][c];
        const double rounding = 8.0 * reference::kFloatRoundoff * (std::abs(coarse[p][c]) + std::abs(fine[p][c]));
        comparison.value(p, "output", output[p][c], expected, halfTolerance(expected, rounding));
      }
    });
    comparison.expect(0.0);
  }
}

// On a flat wall without sky, away from the border, one iteration over blocks of 2x2 has 6x6 samples of weight 1 to the
// rounding of unit vectors, and their moments are those of the pixels in the window.
TEST_F(BlockViewsTest, MomentsAreThoseOfTheWindow) {
  ViewedRegression run(
      device(), {.size = 2, .iterations = 1},
      {"edges", "feature-mean", "feature-mean-2", "colour-mean", "covariance-normal", "covariance-normal-2",
       "covariance-occlusion", "covariance-scalars", "covariance-x", "covariance-o"});
  Inputs in = inputsOf(flatWall());
  // Features that vary on a plane that does not.
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const glm::dvec3 n = glm::normalize(glm::dvec3(0.2 * std::sin(0.9 * p.x), 0.2 * std::cos(0.7 * p.y), 1.0));
    const glm::dvec2 uv = reference::octahedralEncode(n);
    in.guides[p].features = {reference::roundToUnorm16(uv.x), reference::roundToUnorm16(uv.y)};
    in.occlusion[p] = reference::roundToHalf(0.5 + 0.25 * std::sin(0.5 * p.x + 0.3 * p.y));
  });
  run.filter(in.frame, in.guides, in.accumulated, in.occlusion);
  const Image<glm::dvec3> edges = run.view("edges");
  const Image<glm::dvec3> means = run.view("feature-mean");
  const Image<glm::dvec3> scalars = run.view("feature-mean-2");
  const Image<glm::dvec3> colours = run.view("colour-mean");
  const Image<glm::dvec3> variances = run.view("covariance-normal");
  const Image<glm::dvec3> mixed = run.view("covariance-normal-2");
  const Image<glm::dvec3> withOcclusion = run.view("covariance-occlusion");
  const Image<glm::dvec3> scalarCovariances = run.view("covariance-scalars");
  const Image<glm::dvec3> colourX = run.view("covariance-x");
  const Image<glm::dvec3> colourO = run.view("covariance-o");
  Comparison comparison("moments of a block's window");
  for (int by = 2; by < kSize.y / 2 - 2; ++by) {
    for (int bx = 2; bx < kSize.x / 2 - 2; ++bx) {
      const glm::ivec2 p(2 * bx, 2 * by);
      const Window window(in, p - 2);
      const auto mean = [&](const char* name, double actual, int i) {
        comparison.value(p, name, actual, window.mean(i), window.meanTolerance(i));
      };
      const auto covariance = [&](const char* name, double actual, int i, int j) {
        comparison.value(p, name, actual, window.covariance(i, j), window.covarianceTolerance(i, j));
      };
      comparison.compared();
      comparison.value(p, "W", edges[p].z, 36.0, 36.0 * kStored);
      comparison.value(p, "lost", edges[p].y, 0.0, 0.0);
      comparison.value(p, "nearest edge", edges[p].x, 2.0, 0.0);
      mean("occlusion", scalars[p].y, kOcclusion);
      covariance("variance of occlusion", scalarCovariances[p].z, kOcclusion, kOcclusion);
      constexpr std::array<std::array<int, 2>, 3> kMixed{{{0, 1}, {0, 2}, {1, 2}}};
      for (int c = 0; c < 3; ++c) {
        mean("normal", means[p][c], c);
        mean("colour", colours[p][c], kColour + c);
        covariance("variance", variances[p][c], c, c);
        covariance("covariance", mixed[p][c], kMixed[c][0], kMixed[c][1]);
        covariance("covariance with occlusion", withOcclusion[p][c], c, kOcclusion);
        covariance("covariance of colour", colourX[p][c], kColour + c, 0);
        covariance("covariance of colour and occlusion", colourO[p][c], kColour + c, kOcclusion);
      }
    }
  }
  comparison.expect(0.0);
}

}  // namespace
}  // namespace walr::test
