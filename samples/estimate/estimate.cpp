#include "samples/estimate/estimate.h"

namespace walr {

std::optional<Bounds> estimateOf(const PassWork& work, const FigureTable& table, const Machine& machine) {
  const ShaderFigures* const figures = table.find(*work.dispatch);
  if (figures == nullptr || !figures->wave) return std::nullopt;
  return boundsOn(machine, *figures->wave, static_cast<double>(work.threads), static_cast<double>(figures->waves),
                  static_cast<double>(work.bytes));
}

}  // namespace walr
