#pragma once

#include <vector>

#include "samples/denoise/packed_frame.h"

namespace walr::host {

/// A traced frame with its images in the formats of the host's textures.
struct HostFrame {
  PackedFrame inputs;              ///< Inputs of the denoiser; `inputs.frame.number` is its random seed.
  std::vector<Rgba16> noisyLight;  ///< Sparse light for all pixels, 0 without a sample; empty if light is not sparse.
  std::vector<Rgba16> direct;
  std::vector<Rgba16> emission;
  std::vector<Rgba16> referenceDirect;  ///< For the split view; empty otherwise.
  std::vector<Rgba16> referenceIndirect;
};

HostFrame packHostFrame(Frame frame);

}  // namespace walr::host
