// Constants of the pass that prepares guides and accumulates (temporal_accumulation.comp with GUIDES).
#ifndef WALR_SHADERS_TEMPORAL_GUIDES_AND_ACCUMULATION_H
#define WALR_SHADERS_TEMPORAL_GUIDES_AND_ACCUMULATION_H
#include "../guides/prepare_guides.h"
#include "temporal_accumulation.h"
#include "../common/types.h"
#ifdef __cplusplus
namespace walr {
#endif

struct GuidesAndAccumulationConstants {
  PrepareGuidesConstants guides;
  TemporalAccumulationConstants accumulation;
};

#ifdef __cplusplus
static_assert(sizeof(GuidesAndAccumulationConstants) == 96);
}  // namespace walr
#endif
#endif
