#pragma once

namespace walr {

/// What one wave of 64 threads executes of a shader on an AMD GPU, weighed by the rounds of its loops.
struct WaveCounts {
  double vector = 0.0;  ///< Vector instructions.
  /// Those of them that are integer multiplications of 32 bits, at a quarter of the rate.
  double multiplications = 0.0;
  double transcendentals = 0.0;  ///< Those of them that run on the pipe of roots, reciprocals, exponentials and sines.
  double fetches = 0.0;          ///< Loads, samples and stores of textures and buffers.
  double waits = 0.0;            ///< Waits for fetches; those for the same fetches count once.

  friend bool operator==(const WaveCounts&, const WaveCounts&) = default;
};

}  // namespace walr
