#pragma once

#include "passes/regression/bmfr_fit.h"
#include "tests/passes/reference/guides.h"

namespace walr::reference {

/// A fitted colour, with the error that single-precision arithmetic may have made in it.
struct BmfrResult {
  glm::dvec3 colour{0.0};
  glm::dvec3 error{0.0};
  /// Squared length of the pixel's row of the hat matrix: how much of the errors in its data the fit takes over.
  double leverage = 0.0;
  bool undecided = false;  ///< Rounding may decide whether a feature of the block is linearly dependent on others.
};

/// Blockwise multi-order feature regression (Koskela et al. 2019, 3.3 and 3.4) in double precision, by Gram-Schmidt
/// orthogonalisation applied twice instead of Householder's QR factorisation.
Image<BmfrResult> bmfrFit(const HostFrame& frame, const Image<Guide>& guides, const Image<glm::dvec3>& lighting,
                          const BmfrFitSettings& settings = {});

}  // namespace walr::reference
