#pragma once

#include <cstdint>

#include "samples/render/film.h"
#include "samples/render/reference.h"
#include "samples/render/view.h"
#include "samples/render/world.h"

namespace walr::render {

/// Traces the frames of one world.
class FrameTracer {
 public:
  FrameTracer() = default;
  virtual ~FrameTracer() = default;
  FrameTracer(const FrameTracer&) = delete;
  FrameTracer& operator=(const FrameTracer&) = delete;

  /// See `renderFilm`.
  /// @throws SceneError naming a setting that this tracer does not have
  virtual Film film(const View& view, const SamplingSettings& settings) = 0;
  /// See `renderReference`.
  virtual walr::Reference reference(const View& view, const SamplingSettings& settings,
                                    const ReferenceCoverage& coverage, std::uint64_t& rays) = 0;
};

/// Traces on the processor, with Embree.
class ProcessorTracer final : public FrameTracer {
 public:
  /// @param world  with ray casting; must outlive this
  explicit ProcessorTracer(const World& world) : world_(world) {}

  Film film(const View& view, const SamplingSettings& settings) override { return renderFilm(world_, view, settings); }
  walr::Reference reference(const View& view, const SamplingSettings& settings, const ReferenceCoverage& coverage,
                            std::uint64_t& rays) override {
    return renderReference(world_, view, settings, coverage, rays);
  }

 private:
  const World& world_;
};

}  // namespace walr::render
