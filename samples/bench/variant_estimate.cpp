#include "samples/bench/variant_estimate.h"

#include <stdexcept>

#include "framegraph/compile/compile.h"
#include "integration/denoise_graph.h"
#include "samples/estimate/estimate.h"
#include "samples/estimate/frame_estimate.h"

namespace walr {
namespace {

bool hasDefaultSettings(const Variant& variant) {
  Variant untouched = variant;
  untouched.settings.clear();
  return settingsOf(untouched) == settingsOf(variant);
}

}  // namespace

std::vector<PassEstimate> estimatePasses(const Variant& variant, fg::Extent extent, const FigureTable& table,
                                         const Machine& machine, const InputConventions& conventions) {
  InputConventions own;
  own.specular = conventions.specular;
  own.light = conventions.light;
  const DenoiseGraph declared = declareDenoiseGraph(*makeVariant(variant), extent, own, kComputeHost);
  const fg::CompileResult result = fg::compile(declared.graph.desc(), fg::TableMemoryModel());
  if (!result.ok()) {
    throw std::runtime_error("the frame graph of '" + variant.name + "' does not compile:\n" + result.text());
  }
  const bool known = hasDefaultSettings(variant);
  std::vector<PassEstimate> estimates;
  for (const PassWork& work : workOf(declared.graph.desc(), result.plan)) {
    estimates.push_back({.pass = work.pass,
                         .batch = work.batch,
                         .planned = work.planned,
                         .bytes = work.bytes,
                         .bounds = known ? estimateOf(work, table, machine) : std::nullopt});
  }
  return estimates;
}

std::optional<double> estimatedMicroseconds(const Variant& variant, fg::Extent extent, const FigureTable& table,
                                            const Machine& machine, const InputConventions& conventions) {
  FrameEstimate estimate;
  for (const PassEstimate& pass : estimatePasses(variant, extent, table, machine, conventions))
    estimate.add(pass.batch, pass.bounds);
  return estimate.microseconds();
}

}  // namespace walr
