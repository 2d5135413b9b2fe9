// Constants of the pass that prepares guides and accumulates (temporal_accumulation.comp with GUIDES).
#ifndef WALR_SHADERS_CONSTANTS_GUIDES_AND_ACCUMULATION_H
#define WALR_SHADERS_CONSTANTS_GUIDES_AND_ACCUMULATION_H
#include "prepare_guides.h"
#include "temporal_accumulation.h"
#include "types.h"
#ifdef __cplusplus
namespace walr {
#endif

struct GuidesAndAccumulationConstants {
  PrepareGuidesConstants guides;
  TemporalAccumulationConstants accumulation;
};

#ifdef __cplusplus
static_assert(sizeof(GuidesAndAccumulationConstants) == 92);
}  // namespace walr
#endif
#endif
