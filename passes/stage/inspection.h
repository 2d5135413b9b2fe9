#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "framegraph/declare/graph.h"
#include "passes/conventions/light_pattern.h"
#include "shaders/stage/count.h"

/// Inspecting a method while it runs: history length and light direction of every pixel; views, which are images of
/// intermediate values of a stage, and counters, which say how often something happened in a frame. Each view has a
/// pass of its own, which repeats its stage's work and writes the intermediate value. A view that is not wanted has no
/// pass, no texture and no branch in any shader.
namespace walr {

class StageGraph;

/// A counter: components of a view that hold a count at each pixel, summed over all pixels.
struct CounterInfo {
  std::string_view name;
  std::string_view components;  ///< Which of "XYZ" are summed.
};

/// A view: an image of what happens inside a stage.
struct ViewInfo {
  std::string_view name;
  std::string_view description;  ///< One line: what X, Y and Z hold.
  std::vector<CounterInfo> counters = {};
  bool countEveryIteration = false;  ///< Of a stage with iterations; else only the last is counted.
};

/// A view that a caller wants of a method.
struct DebugView {
  std::string name;     ///< "NAME", or "NAME.T" of iteration T of a stage with iterations; "NAME" is that of the last.
  fg::Texture texture;  ///< Of format `kViewFormat` and the inputs' extent. The method leaves its new version here.
  bool written = false;
};

/// Format of the textures of views.
inline constexpr VkFormat kViewFormat = VK_FORMAT_R32G32B32A32_SFLOAT;

/// Bytes of the buffer that receives counters.
inline constexpr std::uint64_t kCounterBytes = kCounterWords * sizeof(std::uint32_t);

/// A counter of a recorded graph.
struct Counter {
  std::string name;  ///< Followed by ".T" for iteration T if every iteration is counted.
  std::vector<std::uint32_t> words;

  /// Its value in a frame.
  /// @param buffer the words of the buffer that received the counters
  [[nodiscard]] std::uint64_t value(std::span<const std::uint32_t> buffer) const;
};

/// Which iteration of a stage.
struct StageIteration {
  std::uint32_t index = 0;
  std::uint32_t count = 0;  ///< 0: the stage does not iterate.
  [[nodiscard]] bool last() const { return index + 1 >= count; }
};

/// The views and counters that a caller wants of a method, for `Denoiser::add`, and those that it gets.
class Inspection {
 public:
  /// Have a view written.
  void want(std::string name, fg::Texture texture) { views_.push_back({std::move(name), texture}); }
  /// Have all counters of the method written.
  /// @param buffer of `kCounterBytes`
  void wantCounters(fg::Buffer buffer) { buffer_ = buffer; }

  /// Have the history length of every pixel written: the number of frames, with the present one, in the mean of its
  /// light; 0 where there is nothing to denoise.
  /// @param texture of `kHistoryLengthFormat` and the inputs' extent
  void wantHistoryLength(fg::Texture texture) { historyLength_ = texture; }

  /// Have the slopes of the light over the normal written for every pixel.
  /// @param texture of `kLightDirectionFormat` and the inputs' extent
  void wantLightDirection(fg::Texture texture) { lightDirection_ = texture; }

  /// Have the expected error of the result written for every pixel.
  /// @param texture of `kExpectedErrorFormat` and the inputs' extent
  void wantExpectedError(fg::Texture texture) { expectedError_ = texture; }

  /// The texture of expected errors as the last pass leaves it; not valid if nobody wants it.
  [[nodiscard]] fg::Texture expectedError() const { return expectedError_; }
  /// The texture of light directions as the last pass leaves it; not valid if nobody wants it.
  [[nodiscard]] fg::Texture lightDirection() const { return lightDirection_; }
  /// The texture of history lengths as the last pass leaves it; not valid if nobody wants it.
  [[nodiscard]] fg::Texture historyLength() const { return historyLength_; }
  [[nodiscard]] const std::vector<DebugView>& views() const { return views_; }
  /// The counters' buffer as the last pass leaves it.
  [[nodiscard]] fg::Buffer counterBuffer() const { return buffer_; }
  [[nodiscard]] const std::vector<Counter>& counters() const { return counters_; }
  /// Views of the stages that the method has with its present settings.
  [[nodiscard]] const std::vector<ViewInfo>& known() const { return known_; }

  /// Declares the pass of a view: all but the view's number and texture.
  using DeclareView = std::function<fg::PassBuilder(const std::string& passName)>;
  /// Called by a stage: add a pass for each of its wanted views.
  /// @param views   in the order of `view` of the stage's shader, which writes `outView`
  /// @param extent  of the inputs
  void offer(StageGraph graph, std::span<const ViewInfo> views, fg::Extent extent, const DeclareView& declare,
             StageIteration iteration = {});

  /// Called by the stage that accumulates light: write the history length, if it is wanted.
  /// @param channel, groups see `addHistoryLength`
  void offerHistoryLength(StageGraph graph, fg::Texture accumulated, std::uint32_t channel,
                          const LightPattern& groups = {});

  /// Called by the stage that evaluates the light at the normals of pixels: write its slopes, if they are wanted.
  /// @param declare declares the pass, all but the texture
  void offerLightDirection(const DeclareView& declare);

  /// Called by the method that knows the mean over time and the result: write the expected error, if it is wanted.
  /// @param declare declares the pass, all but the texture
  void offerExpectedError(const DeclareView& declare);

  /// @throws std::invalid_argument if the expected error is wanted and the method does not have it
  void requireExpectedError() const;
  /// @throws std::invalid_argument if the light direction is wanted and no stage has it
  void requireLightDirection() const;
  /// @throws std::invalid_argument if the history length is wanted and no stage has it
  void requireHistoryLength() const;
  /// @throws std::invalid_argument naming a wanted view that no stage has written, and the known ones
  void requireViews() const;

 private:
  void count(StageGraph graph, const ViewInfo& view, const std::string& suffix, fg::Texture texture);

  std::vector<DebugView> views_;
  fg::Texture historyLength_;
  bool historyLengthWritten_ = false;
  fg::Texture lightDirection_;
  bool lightDirectionWritten_ = false;
  fg::Texture expectedError_;
  bool expectedErrorWritten_ = false;
  fg::Buffer buffer_;
  std::vector<Counter> counters_;
  std::vector<ViewInfo> known_;
  std::vector<std::uint32_t> iterations_;  ///< By known view: how many its stage has, as above.
  std::uint32_t words_ = 0;                ///< Of the buffer in use.
};

}  // namespace walr
