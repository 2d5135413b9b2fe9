// Views of the regression over blocks: they agree with each other and with the output.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "passes/conventions/light_direction.h"
#include "passes/regression/block_regression.h"
#include "tests/passes/block_filter.h"
#include "tests/passes/comparison.h"
#include "tests/passes/host_textures.h"
#include "tests/passes/reference/block_regression.h"
#include "tests/passes/reference/hash.h"
#include "tests/passes/reference/linear_system.h"
#include "tests/passes/reference/octahedral.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::block_views_test {
namespace {

using reference::HostFrame;
using reference::Image;

constexpr glm::ivec2 kSize(45, 34);  // Not a multiple of the block size.

/// The regression alone, with views.
class ViewedRegression {
 public:
  ViewedRegression(const fg::test::TestDevice& device, const BlockRegressionSettings& settings,
                   const std::vector<std::string>& views, bool lightDirection = false)
      : frame_(graph_.upload("frame constants", sizeof(FrameConstants))),
        guides_(importGuides(graph_, kSize, true)),
        accumulated_(importHalves(graph_, "accumulated", kSize)) {
    const fg::Extent extent{static_cast<std::uint32_t>(kSize.x), static_cast<std::uint32_t>(kSize.y)};
    Inspection inspection;
    for (const std::string& view : views)
      inspection.want(view, graph_.import("view of " + view, {kViewFormat, extent}, fg::vk::kOverwritable));
    if (lightDirection) {
      inspection.wantLightDirection(
          graph_.import("light direction", {kLightDirectionFormat, extent}, fg::vk::kOverwritable));
    }
    output_ = copyOut(
        graph_, "result",
        addBlockFilter({graph_, inspection}, frame_, {accumulated_, LightingAlpha::SampleCount}, guides_, settings));
    inspection.requireViews();
    inspection.requireLightDirection();
    direction_ = inspection.lightDirection();
    if (lightDirection) graph_.exported(direction_, fg::vk::kReadable);
    for (const DebugView& view : inspection.views()) {
      graph_.exported(view.texture, fg::vk::kReadable);
      views_[view.name] = view.texture;
    }
    run_ = std::make_unique<fg::test::GraphRun>(device, graph_, fg::vk::ExecutorOptions{.shared = device.pipelines()});
  }

  void filter(const HostFrame& frame, const Image<reference::Guide>& guides, const Image<glm::dvec4>& accumulated) {
    run_->executor().upload(frame_, frame.constants);
    upload(*run_, guides_, guides);
    upload(*run_, accumulated_, accumulated);
    run_->frame();
  }
  [[nodiscard]] Image<glm::dvec4> output() const { return readHalves(*run_, output_, kSize); }
  /// Slopes of the light over x, y or z of the normal, by light direction.
  [[nodiscard]] Image<glm::dvec3> slope(int axis) const {
    const std::vector<std::uint32_t> words = run_->texels<std::uint32_t>(direction_);
    Image<glm::dvec3> image(kSize);
    for (std::size_t i = 0; i < image.pixels().size(); ++i)
      image.pixels()[i] = lightSlopes({words[2 * i], words[2 * i + 1]})[axis];
    return image;
  }
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
  fg::Texture output_;
  fg::Texture direction_;
  std::map<std::string, fg::Texture> views_;
  std::unique_ptr<fg::test::GraphRun> run_;
};

/// Inputs of the regression.
struct Inputs {
  HostFrame frame;
  Image<reference::Guide> guides;
  Image<glm::dvec4> accumulated;
};
Inputs inputsOf(const Scene& scene) {
  Inputs inputs;
  inputs.frame = renderStill(scene, kSize);
  inputs.guides = reference::prepareGuides(inputs.frame, reference::Storage::Quantised, {}, kOcclusionInSmallImages);
  inputs.accumulated = withAlpha(inputs.frame.lighting);
  for (glm::dvec4& sample : inputs.accumulated.pixels()) sample.a = 1.0;
  return inputs;
}

/// Error of unpacked ambient occlusion, a quotient: 2.5 units in the last place (Vulkan, "Precision of core
/// operations"), each at most two roundoffs.
constexpr double kUnpacked = 5.0 * reference::kFloatRoundoff;

/// Largest relative error of a block's moments, which are stored as halves once, before the iteration.
constexpr double kStored = 2.0 * reference::kHalfRoundoff;

constexpr int kFeatures = 5;  ///< Three components of the normal, depth, ambient occlusion.
constexpr int kDepth = 3;
constexpr int kOcclusion = 4;
constexpr int kValues = 8;  ///< Values of a sample: features and colour.

/// The moments of the block that a pixel lies in, read from their views.
struct ViewedMoments {
  std::array<double, kValues> mean{};
  reference::Matrix<kValues> covariance{};  ///< Covariances among colours are not stored.
};

const std::vector<std::string>& momentViews() {
  static const std::vector<std::string> kViews{
      "feature-mean",     "feature-mean-2",       "colour-mean",        "covariance-normal", "covariance-normal-2",
      "covariance-depth", "covariance-occlusion", "covariance-scalars", "covariance-x",      "covariance-y",
      "covariance-z",     "covariance-d",         "covariance-o"};
  return kViews;
}

class MomentViews {
 public:
  explicit MomentViews(const ViewedRegression& run) {
    for (const std::string& name : momentViews()) images_[name] = run.view(name);
  }
  [[nodiscard]] ViewedMoments at(glm::ivec2 p) const {
    const auto view = [&](const char* name) { return images_.at(name)[p]; };
    ViewedMoments m;
    const auto covariance = [&](int i, int j, double value) { m.covariance[i][j] = m.covariance[j][i] = value; };
    const glm::dvec3 scalarMeans = view("feature-mean-2");
    m.mean[kDepth] = scalarMeans.x;
    m.mean[kOcclusion] = scalarMeans.y;
    EXPECT_EQ(scalarMeans.z, 0.0);
    constexpr std::array<std::array<int, 2>, 3> kMixed{{{0, 1}, {0, 2}, {1, 2}}};
    constexpr std::array kWithColour{"covariance-x", "covariance-y", "covariance-z", "covariance-d", "covariance-o"};
    for (int c = 0; c < 3; ++c) {
      m.mean[c] = view("feature-mean")[c];
      m.mean[kFeatures + c] = view("colour-mean")[c];
      covariance(c, c, view("covariance-normal")[c]);
      covariance(kMixed[c][0], kMixed[c][1], view("covariance-normal-2")[c]);
      covariance(kDepth, c, view("covariance-depth")[c]);
      covariance(kOcclusion, c, view("covariance-occlusion")[c]);
      for (int i = 0; i < kFeatures; ++i) covariance(i, kFeatures + c, view(kWithColour[i])[c]);
    }
    const glm::dvec3 scalars = view("covariance-scalars");
    covariance(kDepth, kDepth, scalars.x);
    covariance(kOcclusion, kDepth, scalars.y);
    covariance(kOcclusion, kOcclusion, scalars.z);
    return m;
  }

 private:
  std::map<std::string, Image<glm::dvec3>> images_;
};

/// Moments of 6x6 pixels of one plane, with weights by how their shading normals face it, and bounds of the error that
/// storing the blocks' moments adds.
class Window {
 public:
  /// @param depth depth of the block, to which the depth feature is relative
  Window(const Inputs& in, glm::ivec2 first, double depth) {
    for (int k = 0; k < kCount; ++k) {
      const glm::ivec2 q = first + glm::ivec2(k % 6, k / 6);
      const glm::dvec3 n = reference::octahedralDecode(in.guides[q].features);
      const glm::dvec4 y = in.accumulated[q];
      samples_[k] = {n.x, n.y, n.z, depth / in.guides[q].depth - 1.0, in.guides[q].occlusion, y.r, y.g, y.b};
      weights_[k] = std::clamp(glm::dot(n, in.guides[q].normal), 0.0, 1.0);
    }
    weight_ = std::accumulate(weights_.begin(), weights_.end(), 0.0);
    for (int i = 0; i < kValues; ++i) {
      for (int k = 0; k < kCount; ++k) {
        mean_[i] += weights_[k] * samples_[k][i] / weight_;
        size_[i] = std::max(size_[i], std::abs(samples_[k][i]));
      }
      for (const auto& sample : samples_) spread_[i] = std::max(spread_[i], std::abs(sample[i] - mean_[i]));
    }
  }
  [[nodiscard]] double weight() const { return weight_; }
  [[nodiscard]] double mean(int i) const { return mean_[i]; }
  [[nodiscard]] double meanTolerance(int i) const { return kStored * size_[i] + kArithmetic * terms(i); }
  [[nodiscard]] double covariance(int i, int j) const {
    double sum = 0.0;
    for (int k = 0; k < kCount; ++k)
      sum += weights_[k] * (samples_[k][i] - mean_[i]) * (samples_[k][j] - mean_[j]) / weight_;
    return sum;
  }
  /// The blocks' stored covariances are no larger than the product of the spreads. The stored means are rounded too,
  /// and their spread about the window's mean adds to the covariance.
  [[nodiscard]] double covarianceTolerance(int i, int j) const {
    const double stored = spread_[i] * spread_[j] + size_[i] * spread_[j] + spread_[i] * size_[j];
    return kStored * stored + kArithmetic * terms(i) * terms(j);
  }

 private:
  static constexpr int kCount = 36;
  static constexpr double kArithmetic = 64.0 * reference::kFloatRoundoff;  // A few sums of some tens of terms.
  /// Size of the terms of which a value is the difference: the depth feature is a quotient less 1.
  [[nodiscard]] double terms(int i) const { return i == kDepth ? 1.0 : size_[i]; }

  std::array<std::array<double, kValues>, kCount> samples_{};
  std::array<double, kCount> weights_{};
  double weight_ = 0.0;
  std::array<double, kValues> mean_{};
  std::array<double, kValues> size_{};
  std::array<double, kValues> spread_{};
};

/// Depth of a 2x2 block's representative pixel, chosen at random. All four pixels must show a surface.
double blockDepth(const Inputs& in, glm::ivec2 block) {
  const auto pixel = static_cast<int>(reference::hashBelow(glm::uvec4(block, in.frame.constants.frameIndex, 0), 4));
  return in.guides[2 * block + glm::ivec2(pixel / 2, pixel % 2)].depth;
}

/// A flat wall with all five features varying over it. Its geometric normal is one that the guides store exactly, so
/// that all of the wall lies on the plane of each of its blocks.
Inputs wallOfManyFeatures() {
  Inputs in = inputsOf(wallFacing(reference::roundToShortNormal(glm::normalize(glm::dvec3(0.3, 0.2, 1.0)))));
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const double tilt = 0.6 + 0.5 * std::sin(1.3 * p.x + 2.1 * p.y);
    const double turn = 2.9 * p.x + 1.7 * p.y;
    const glm::dvec3 n(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt));
    const glm::dvec2 uv = reference::octahedralEncode(n);
    in.guides[p].features = {reference::roundToUnorm(uv.x, reference::kUnorm12Step),
                             reference::roundToUnorm(uv.y, reference::kUnorm12Step)};
    in.guides[p].occlusion =
        reference::roundToUnorm(0.5 + 0.25 * std::sin(0.5 * p.x + 0.3 * p.y), reference::kUnorm8Step);
  });
  return in;
}

/// The ridge of a feature, which includes the rounding of covariances stored as halves.
double ridgeOf(const ViewedMoments& m, int feature, double ridge) {
  return ridge + kFeatures * reference::kHalfRoundoff * std::max(m.covariance[feature][feature], 0.0);
}

/// The features' covariance matrix with its ridge, from the views.
reference::Matrix<kFeatures> normalMatrix(const ViewedMoments& m, double ridge) {
  reference::Matrix<kFeatures> a{};
  for (int i = 0; i < kFeatures; ++i) {
    for (int j = 0; j < kFeatures; ++j) a[i][j] = m.covariance[i][j];
    a[i][i] = std::max(a[i][i], 0.0) + ridgeOf(m, i, ridge);
  }
  return a;
}

double trace(const reference::Matrix<kFeatures>& a) {
  double sum = 0.0;
  for (int i = 0; i < kFeatures; ++i) sum += a[i][i];
  return sum;
}

/// Relative error of a Cholesky decomposition of five rows. Its backward error is below (n + 1) u / (1 - (n + 1) u) of
/// |L| |L^T| (Higham, Accuracy and Stability of Numerical Algorithms, theorem 10.3).
constexpr double kDecomposed = 7.0 * reference::kFloatRoundoff;

class BlockViewsTest : public fg::test::GpuTest {};

// The output mixes fine and coarse fits by the share that follows from the sample counts.
TEST_F(BlockViewsTest, TheMixtureIsTheOutput) {
  const BlockRegressionSettings settings{.size = 2, .iterations = 2};
  ViewedRegression run(device(), settings, {"samples", "occlusion", "fine-fit", "coarse-fit", "few-samples"});
  for (const NamedScene& named : allScenes()) {
    SCOPED_TRACE(named.name);
    const Inputs in = inputsOf(named.scene);
    run.filter(in.frame, in.guides, in.accumulated);
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
      comparison.value(p, "occlusion", occlusion[p].x, in.guides[p].occlusion, kUnpacked);
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

// The light direction holds the slopes of the mixture of fine and coarse fits, rounded to 1/31 of the largest one.
TEST_F(BlockViewsTest, LightDirectionHoldsTheSlopesOfTheMixture) {
  constexpr std::array kFine{"slope-x", "slope-y", "slope-z"};
  constexpr std::array kCoarse{"coarse-slope-x", "coarse-slope-y", "coarse-slope-z"};
  std::vector<std::string> views{"samples"};
  views.insert(views.end(), kFine.begin(), kFine.end());
  views.insert(views.end(), kCoarse.begin(), kCoarse.end());
  ViewedRegression run(device(), {.size = 2, .iterations = 2}, views, true);
  double largestOfAll = 0.0;
  for (const NamedScene& named : allScenes()) {
    SCOPED_TRACE(named.name);
    const Inputs in = inputsOf(named.scene);
    run.filter(in.frame, in.guides, in.accumulated);
    const Image<glm::dvec3> samples = run.view("samples");
    std::vector<Image<glm::dvec3>> expected;
    std::vector<Image<glm::dvec3>> actual;
    for (int axis = 0; axis < 3; ++axis) {
      const Image<glm::dvec3> fine = run.view(kFine.at(axis));
      const Image<glm::dvec3> coarse = run.view(kCoarse.at(axis));
      expected.emplace_back(kSize);
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        const double share = samples[p].y;
        expected.back()[p] = (1.0 - share) * fine[p] + share * coarse[p];
      });
      actual.push_back(run.slope(axis));
    }
    Comparison comparison("light direction");
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      comparison.compared();
      double largest = 0.0;
      for (const auto& slope : expected) {
        for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(slope[p][c]));
      }
      largestOfAll = std::max(largestOfAll, largest);
      // Half a unit, which is less than 2/31 of the largest slope, and the rounding of the views.
      const double tolerance = largest * (1.0 / 31.0 + 16.0 * reference::kFloatRoundoff);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (int c = 0; c < 3; ++c) comparison.value(p, "slope", actual[axis][p][c], expected[axis][p][c], tolerance);
      }
    });
    comparison.expect(0.0);
  }
  EXPECT_GT(largestOfAll, 0.01) << "no scene has a slope worth comparing";
}

// On a flat wall without sky, away from the border, one iteration over blocks of 2x2 covers 6x6 samples, whose weights
// are 1 up to the rounding of unit vectors. The moments in the views must be those of these pixels.
TEST_F(BlockViewsTest, MomentsAreThoseOfTheWindow) {
  std::vector<std::string> wanted = momentViews();
  wanted.push_back("edges");
  ViewedRegression run(device(), {.size = 2, .iterations = 1}, wanted);
  const Inputs in = wallOfManyFeatures();
  run.filter(in.frame, in.guides, in.accumulated);
  const Image<glm::dvec3> edges = run.view("edges");
  const MomentViews views(run);
  Comparison comparison("moments of a block's window");
  for (int by = 2; by < kSize.y / 2 - 2; ++by) {
    for (int bx = 2; bx < kSize.x / 2 - 2; ++bx) {
      const glm::ivec2 p(2 * bx, 2 * by);
      const Window window(in, p - 2, blockDepth(in, {bx, by}));
      const ViewedMoments m = views.at(p);
      comparison.compared();
      comparison.value(p, "W", edges[p].z, window.weight(), window.weight() * kStored);
      comparison.value(p, "lost", edges[p].y, 0.0, 0.0);
      comparison.value(p, "nearest edge", edges[p].x, 2.0, 0.0);
      for (int i = 0; i < kValues; ++i) {
        comparison.value(p, "mean", m.mean[i], window.mean(i), window.meanTolerance(i));
        for (int j = 0; j <= i && j < kFeatures; ++j)
          comparison.value(p, "covariance", m.covariance[i][j], window.covariance(i, j),
                           window.covarianceTolerance(i, j));
      }
    }
  }
  comparison.expect(0.0);
}

// The smallest pivot must be that of the block's matrix. Each pivot is 1 over the last diagonal entry of the inverse of
// a leading submatrix. It is a Schur complement, in which the decomposition's error counts (1 + |w|)^2 times, where w
// eliminates the rows before.
TEST_F(BlockViewsTest, PivotsAreThoseOfTheMoments) {
  std::vector<std::string> wanted = momentViews();
  wanted.push_back("pivots");
  for (const float ridge : {1e-4F, 3e-2F}) {
    ViewedRegression run(device(), {.size = 2, .iterations = 2, .ridge = ridge}, wanted);
    for (const Inputs& in : {wallOfManyFeatures(), inputsOf(sphere()), inputsOf(stairs())}) {
      run.filter(in.frame, in.guides, in.accumulated);
      const Image<glm::dvec3> pivots = run.view("pivots");
      const MomentViews views(run);
      Comparison comparison("pivots");
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        if (pivots[p] == glm::dvec3(0.0)) return;  // The block has no surface.
        const ViewedMoments moments = views.at(p);
        const reference::Matrix<kFeatures> a = normalMatrix(moments, double(ridge));
        double smallest = std::numeric_limits<double>::infinity();
        double error = 0.0;
        int outweighed = 0;
        bool certain = true;
        for (int k = 0; k < kFeatures; ++k) {
          // The leading k+1 rows; the identity in the rest.
          reference::Matrix<kFeatures> leading{};
          for (int i = 0; i < kFeatures; ++i)
            for (int j = 0; j < kFeatures; ++j) leading[i][j] = i <= k && j <= k ? a[i][j] : i == j ? 1.0 : 0.0;
          const reference::Matrix<kFeatures> inverted = reference::inverse(leading);
          const double pivot = 1.0 / inverted[k][k];
          double eliminated = 1.0;
          for (int i = 0; i < k; ++i) eliminated += std::abs(inverted[k][i]) * pivot;
          const double itsRidge = ridgeOf(moments, k, double(ridge));
          // Up to rounding, no pivot is smaller than its ridge.
          const double above = std::max(pivot / itsRidge - 1.0, 0.0);
          const double itsError = kDecomposed * trace(a) * eliminated * eliminated / itsRidge;
          smallest = std::min(smallest, above);
          error = std::max(error, itsError);
          outweighed += above < 1.0 ? 1 : 0;
          certain = certain && std::abs(above - 1.0) > itsError;
        }
        comparison.compared();
        comparison.value(p, "smallest pivot", pivots[p].x, smallest, error);
        if (certain) {
          comparison.value(p, "outweighed", pivots[p].y, outweighed, 0.0);
          comparison.value(p, "any outweighed", pivots[p].z, outweighed > 0 ? 1.0 : 0.0, 0.0);
        }
      });
      comparison.expect(0.0);
    }
  }
}

// On the wall, away from the border, a pixel's slopes are those of the four blocks around it, mixed bilinearly. The
// test solves for them from the moments in the views, which the filter stores as halves.
TEST_F(BlockViewsTest, SlopesAreMixedFromTheFourBlocksAround) {
  constexpr std::array kSlopes{"slope-x", "slope-y", "slope-z", "slope-depth", "slope-occlusion"};
  std::vector<std::string> wanted = momentViews();
  wanted.insert(wanted.end(), kSlopes.begin(), kSlopes.end());
  const BlockRegressionSettings settings{.size = 2, .iterations = 1, .ridge = 1e-3F};
  ViewedRegression run(device(), settings, wanted);
  const Inputs in = wallOfManyFeatures();
  run.filter(in.frame, in.guides, in.accumulated);
  const MomentViews views(run);
  Comparison comparison("slopes");
  for (std::size_t feature = 0; feature < kSlopes.size(); ++feature) {
    const Image<glm::dvec3> slopes = run.view(kSlopes[feature]);
    for (int y = 6; y < kSize.y - 6; ++y) {
      for (int x = 6; x < kSize.x - 6; ++x) {
        const glm::ivec2 p(x, y);
        const glm::dvec2 position = (glm::dvec2(p) + 0.5) / 2.0 - 0.5;
        const glm::ivec2 base(glm::floor(position));
        const glm::dvec2 f = position - glm::dvec2(base);
        glm::dvec3 expected(0.0);
        glm::dvec3 tolerance(0.0);
        for (int i = 0; i < 4; ++i) {
          const glm::ivec2 offset(i % 2, i / 2);
          const double weight = (offset.x == 1 ? f.x : 1.0 - f.x) * (offset.y == 1 ? f.y : 1.0 - f.y);
          const ViewedMoments m = views.at(2 * (base + offset));
          const reference::Matrix<kFeatures> a = normalMatrix(m, double(settings.ridge));
          const reference::Matrix<kFeatures> inverted = reference::inverse(a);
          for (int c = 0; c < 3; ++c) {
            reference::Vector<kFeatures> right{};
            for (int k = 0; k < kFeatures; ++k) right[k] = m.covariance[k][kFeatures + c];
            reference::Vector<kFeatures> solved{};
            for (int k = 0; k < kFeatures; ++k) solved[k] = reference::dot(inverted[k], right);
            double size = 0.0;
            for (const double slope : solved) size += std::abs(slope);
            expected[c] += weight * solved[feature];
            // Error of the decomposition and both substitutions, each with the decomposition's bound; of the store; of
            // the four weights.
            tolerance[c] += weight * (3.0 * kDecomposed * trace(inverted) * trace(a) * size +
                                      (kStored + 16.0 * reference::kFloatRoundoff) * std::abs(solved[feature]));
          }
        }
        comparison.compared();
        for (int c = 0; c < 3; ++c) comparison.value(p, kSlopes[feature], slopes[p][c], expected[c], tolerance[c]);
      }
    }
  }
  comparison.expect(0.0);
}

// In a corner of the image only one cell's fit counts. It stands in for the three outside the image, too, with weights
// that add up to 1. So its slopes must explain the difference of its colours at two pixels. No view shows the depth to
// which the depth feature is relative. One pixel determines it; the others must agree.
TEST_F(BlockViewsTest, CoarseSlopesAreThoseOfTheCoarseFit) {
  constexpr std::array kSlopes{"coarse-slope-x", "coarse-slope-y", "coarse-slope-z", "coarse-slope-depth",
                               "coarse-slope-occlusion"};
  std::vector<std::string> wanted{"coarse-fit", "coarse-clamped"};
  wanted.insert(wanted.end(), kSlopes.begin(), kSlopes.end());
  // Cells have 8x8 pixels, the largest size there is: 0.2 x 34 / 0.5 pixels would allow more.
  const BlockRegressionSettings settings{
      .size = 2, .iterations = 1, .coarseSigma = 0.2F, .coarseReach = 3.0F, .coarseResolution = 0.5F};
  constexpr int kCell = 8;
  ViewedRegression run(device(), settings, wanted);
  const Inputs in = wallOfManyFeatures();
  run.filter(in.frame, in.guides, in.accumulated);
  const Image<glm::dvec3> fit = run.view("coarse-fit");
  std::array<Image<glm::dvec3>, kFeatures> slopes;
  for (int k = 0; k < kFeatures; ++k) slopes[k] = run.view(kSlopes[k]);
  const Image<glm::dvec3> clamped = run.view("coarse-clamped");
  const auto featuresAt = [&](glm::ivec2 p) {
    const glm::dvec3 n = reference::octahedralDecode(in.guides[p].features);
    return std::array{n.x, n.y, n.z, 1.0 / in.guides[p].depth, in.guides[p].occlusion};
  };
  Comparison comparison("coarse slopes");
  const glm::ivec2 origin(0);
  for (int c = 0; c < 3; ++c) {
    // At each pixel of the corner, the part of the colour that is left for the depth feature, divided by its slope.
    const auto rest = [&](glm::ivec2 p) {
      double value = fit[p][c] - fit[origin][c];
      for (int k = 0; k < kFeatures; ++k)
        if (k != kDepth) value -= slopes[k][origin][c] * (featuresAt(p)[k] - featuresAt(origin)[k]);
      return value;
    };
    const auto step = [&](glm::ivec2 p) {
      return slopes[kDepth][origin][c] * (featuresAt(p)[kDepth] - featuresAt(origin)[kDepth]);
    };
    double terms = std::abs(fit[origin][c]) + 2.0 * std::abs(slopes[kDepth][origin][c]);
    for (int k = 0; k < kFeatures; ++k) terms += std::abs(slopes[k][origin][c]);
    const double rounding = 32.0 * reference::kFloatRoundoff * terms;
    glm::ivec2 farthest = origin;
    for (int i = 0; i < kCell * kCell / 4; ++i) {
      const glm::ivec2 p(i % (kCell / 2), i / (kCell / 2));
      if (std::abs(step(p)) > std::abs(step(farthest))) farthest = p;
    }
    ASSERT_NE(farthest, origin);
    const double depth = rest(farthest) / step(farthest);
    EXPECT_NEAR(depth, in.guides[origin].depth, 0.5 * in.guides[origin].depth);
    for (int i = 0; i < kCell * kCell / 4; ++i) {
      const glm::ivec2 p(i % (kCell / 2), i / (kCell / 2));
      comparison.compared();
      EXPECT_EQ(clamped[p], glm::dvec3(0.0));
      for (int k = 0; k < kFeatures; ++k) {
        // At either pixel: a product, three additions in the sum and in its weights, a division to 2.5 ULP.
        const double meanRounding = 2.0 * 12.0 * reference::kFloatRoundoff * std::abs(slopes[k][origin][c]);
        comparison.value(p, kSlopes[k], slopes[k][p][c], slopes[k][origin][c], meanRounding);
      }
      comparison.value(p, "fit", rest(p), depth * step(p), 2.0 * rounding);
    }
  }
  comparison.expect(0.0);
}

// Light that grows with the normal's x falls below 0 at the one pixel whose normal is turned farther than all others
// and that has no sample of its own.
TEST_F(BlockViewsTest, ClampedFitsAreThoseBelowZero) {
  ViewedRegression run(device(), {.size = 2, .iterations = 2, .ridge = 1e-6F},
                       {"clamped", "coarse-clamped", "fine-fit", "coarse-fit"});
  Inputs in = inputsOf(flatWall());
  constexpr glm::ivec2 kTurned(21, 16);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const glm::dvec3 n = p == kTurned
                             ? glm::normalize(glm::dvec3(-3.0, 0.0, 1.0))
                             : glm::normalize(glm::dvec3(0.4 * std::sin(0.9 * p.x), 0.4 * std::cos(0.7 * p.y), 1.0));
    const glm::dvec2 uv = reference::octahedralEncode(n);
    in.guides[p].features = {reference::roundToUnorm(uv.x, reference::kUnorm12Step),
                             reference::roundToUnorm(uv.y, reference::kUnorm12Step)};
    in.accumulated[p] = glm::dvec4(glm::dvec3(reference::roundToHalf(0.6 + n.x)), p == kTurned ? 0.0 : 1.0);
  });
  run.filter(in.frame, in.guides, in.accumulated);
  struct Views {
    const char* flag;
    const char* fit;
  };
  for (const Views& views : {Views{"clamped", "fine-fit"}, Views{"coarse-clamped", "coarse-fit"}}) {
    const Image<glm::dvec3> flags = run.view(views.flag);
    const Image<glm::dvec3> colours = run.view(views.fit);
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      EXPECT_EQ(flags[p], glm::dvec3(p == kTurned ? 1.0 : 0.0)) << views.flag << " at " << p.x << ", " << p.y;
      if (p == kTurned) {
        EXPECT_EQ(colours[p], glm::dvec3(0.0)) << views.fit;
      } else {
        EXPECT_GT(colours[p].r, 0.0) << views.fit << " at " << p.x << ", " << p.y;
      }
    });
  }
}

}  // namespace
}  // namespace walr::test::block_views_test
