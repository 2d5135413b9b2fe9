#pragma once

// Embree 3 and 4 differ in how a ray query takes its context. Everything else that the project uses is the same in
// both.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace walr::render::embree {

inline void intersect(RTCScene scene, RTCRayHit& rayHit) {
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(scene, &rayHit);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &rayHit);
#endif
}

inline void occluded(RTCScene scene, RTCRay& ray) {
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded1(scene, &ray);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
#endif
}

}  // namespace walr::render::embree
