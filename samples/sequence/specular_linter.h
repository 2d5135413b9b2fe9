#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "passes/lint/lint_finding.h"
#include "samples/sequence/frame.h"

namespace walr {

/// Finds errors in the specular light of frames, as `InputLinter` does in what a denoiser takes.
///
/// Light that was not divided by its albedo is found from pairs of pixels on one surface whose specular albedo differs
/// (see `LintJudge::judgeAlbedo`), so only where surfaces have textures of metal or of its colour. The encoding of
/// roughness is found on dielectrics, whose albedo depends on roughness in a known way. Frames without a distance come
/// from Cycles, whose albedo is another one; without roughness, which changes the light, too, pairs tell nothing. Lobes
/// that were swapped are found on metals, which reflect no diffuse light.
class SpecularLinter {
 public:
  /// Add a frame; one without specular light is passed over.
  void add(const Frame& frame);

  /// What was found in all frames.
  [[nodiscard]] std::vector<LintFinding> findings() const;

 private:
  void addPair(const Frame& frame, std::size_t here, std::size_t there);
  void addRoughness(const Frame& frame, std::size_t pixel);
  void addMetal(const Frame& frame, std::size_t pixel);

  std::uint64_t notFinite_ = 0;
  std::uint64_t negative_ = 0;
  std::uint64_t badDistances_ = 0;
  std::uint64_t badRoughness_ = 0;
  std::uint64_t pairs_ = 0;
  double balance_ = 0.0;
  double variance_ = 0.0;
  std::array<std::uint64_t, 3> encodings_{};  ///< Pixels whose roughness is linear, squared, a square root.
  /// Pixels of metals, and those of them with light of each lobe.
  struct Metals {
    std::uint64_t all = 0;
    std::uint64_t diffuse = 0;
    std::uint64_t specular = 0;
  } metals_;
};

}  // namespace walr
