#pragma once

#include "passes/methods/walr_paper.h"
#include "tests/passes/reference/atrous.h"
#include "tests/passes/reference/temporal_antialiasing.h"

namespace walr::reference {

/// The method `walr_paper` (Meunier & Harada 2022, figure 6) in double precision, with its histories.
class Walr {
 public:
  explicit Walr(Storage storage, const WalrPaperSettings& settings = robustWalr())
      : storage_(storage), settings_(settings) {}

  /// Denoise the next frame.
  Image<glm::dvec3> denoise(const HostFrame& frame);

  /// Forget all histories.
  void reset();

  /// Input and output of the spatial filter in the last frame.
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
