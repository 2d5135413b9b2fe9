#pragma once

#include "passes/walr_paper.h"
#include "tests/passes/reference/atrous.h"
#include "tests/passes/reference/temporal_antialiasing.h"

namespace walr::reference {

/// All stages of `walr_paper` in double precision, with the histories that they carry from frame to frame.
class Walr {
 public:
  explicit Walr(Storage storage, const WalrPaperSettings& settings = robustWalr())
      : storage_(storage), settings_(settings) {}

  /// The denoised frame.
  Image<glm::dvec3> denoise(const HostFrame& frame);

  /// Forget all histories.
  void reset();

  /// The spatial filter's input and output in the last frame.
  [[nodiscard]] const Image<glm::dvec4>& accumulated() const { return accumulation_.accumulated; }
  [[nodiscard]] const Image<glm::dvec3>& filtered() const { return filtered_; }

 private:
  Storage storage_;
  WalrPaperSettings settings_;
  AccumulationHistory accumulation_;
  AntialiasingHistory antialiasing_;
  Image<glm::dvec3> filtered_;
};

}  // namespace walr::reference
