#include "samples/bench/plan_costs.h"

#include <stdexcept>

#include "framegraph/compile/compile.h"
#include "integration/denoise_graph.h"
#include "samples/bench/variant_estimate.h"

namespace walr {

PlanCosts planCosts(const Variant& variant, fg::Extent extent, const InputConventions& conventions) {
  const DenoiseGraph declared = declareDenoiseGraph(*makeVariant(variant), extent, conventions, kComputeHost);
  const fg::CompileResult result = fg::compile(declared.graph.desc(), fg::TableMemoryModel());
  if (!result.ok()) {
    throw std::runtime_error("the frame graph of '" + variant.name + "' does not compile:\n" + result.text());
  }
  const auto pixels = static_cast<double>(extent.width) * static_cast<double>(extent.height);
  const fg::MemoryReport& memory = result.plan.memory;
  return {.extent = extent,
          .bytesReadPerPixel = static_cast<double>(result.plan.traffic.bytesRead) / pixels,
          .bytesWrittenPerPixel = static_cast<double>(result.plan.traffic.bytesWritten) / pixels,
          .persistentBytes = memory.persistentBytes,
          .transientUnaliasedBytes = memory.transientUnaliasedBytes,
          .transientPeakBytes = memory.transientPeakBytes,
          .estimatedMicroseconds =
              estimatedMicroseconds(variant, extent, shaderFigures(), machineNamed(kDefaultMachine), conventions)};
}

}  // namespace walr
