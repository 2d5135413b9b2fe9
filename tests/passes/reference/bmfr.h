#pragma once

#include "passes/bmfr_fit.h"
#include "tests/passes/reference/guides.h"

namespace walr::reference {

/// A fitted colour, with the error that single-precision arithmetic may have made in it.
struct BmfrResult {
  glm::dvec3 colour{0.0};
  glm::dvec3 error{0.0};
  double leverage =
      0.0;  ///< Squared length of the row of the hat matrix: what the fit takes over of errors in its data.
  bool undecided = false;  ///< Rounding may decide whether one of the block's features counts as dependent.
};

/// The blockwise fit (Koskela et al. 2019, 3.3 and 3.4) in double precision, by Gram-Schmidt orthogonalisation applied
/// twice.
Image<BmfrResult> bmfrFit(const HostFrame& frame, const Image<Guide>& guides, const Image<glm::dvec3>& lighting,
                          const BmfrFitSettings& settings = {});

}  // namespace walr::reference
