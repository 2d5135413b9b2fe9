#pragma once

#include <array>
#include <cstdint>

#include "passes/lint/lint_frame.h"

namespace walr {

/// Compares shading normals with the slope of depth, under mistakes in either.
class LintNormals {
 public:
  enum Mistake : std::uint8_t {
    OtherSpace,
    FlippedY,
    ReversedDepth,
    DeviceDepth,
    Distance,
    InvertedView,
    ZUp,
    YUp,
    ExchangedYZ
  };
  static constexpr std::size_t kMistakes = 9;

  explicit LintNormals(const InputConventions& conventions)
      : world_(conventions.normal == InputConventions::Space::World) {}

  void add(const LintFrame& frame);

  [[nodiscard]] std::uint64_t tested() const { return tested_; }
  /// Samples that fit as stated: a random normal that faces the camera does so with a probability of 0.2.
  [[nodiscard]] std::uint64_t fits() const { return fits_; }
  /// Samples that fit better with a mistake than without, and worse.
  [[nodiscard]] std::uint64_t better(std::size_t mistake) const { return better_.at(mistake); }
  [[nodiscard]] std::uint64_t worse(std::size_t mistake) const { return worse_.at(mistake); }
  /// The mistake that fits best, of those that fit better on at least a tenth of all samples, and better on three times
  /// as many as worse; `kMistakes` if there is none. Where both fit alike, as on floors while the camera only turns
  /// about the vertical, neither counts as better.
  [[nodiscard]] std::size_t best() const;

 private:
  void add(const LintFrame& frame, const LintSample& sample);

  bool world_;
  std::uint64_t tested_ = 0;
  std::uint64_t fits_ = 0;
  std::array<std::uint64_t, kMistakes> better_{};
  std::array<std::uint64_t, kMistakes> worse_{};
  std::array<double, kMistakes> gain_{};  ///< How much nearer the cosines come to 1, summed.
};

}  // namespace walr
