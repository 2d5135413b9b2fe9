#pragma once

#include <cstdint>

#include "passes/settings/settings.h"

namespace walr {

/// How the normal equations are kept solvable.
enum class Regularisation : std::uint32_t {
  Ridge,  ///< A ridge on the diagonal that grows with the noise of the mean.
  Floor,  ///< Pivots are floored (Meunier & Harada 2022, algorithm 1).
};

/// Settings of the regression's solve.
struct RegularisationSettings {
  Regularisation method = Regularisation::Ridge;
  float ridge = 1e-3F;
  float noiseRidge = 0.3F;

  void visit(SettingVisitor& v) {
    static constexpr std::string_view kMethods[] = {"ridge", "floor"};
    v.visitEnum({"regression.regularisation", "How the normal equations are kept solvable", "", 0, 1,
                 "Meunier & Harada 2022, 3.1, algorithm 1"},
                kMethods, method);
    v.visit({"regression.ridge",
             "Ridge on, or floor under, the diagonal of the covariance of the features, which lie in 0..1", "", 1e-9,
             1.0, "measured"},
            ridge);
    v.visit({"regression.noise-ridge", "Further ridge per unit of relative variance of a sample over the sample count",
             "", 0.0, 1e3, "measured"},
            noiseRidge);
  }
};

}  // namespace walr
