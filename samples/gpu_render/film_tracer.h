#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "samples/gpu_render/gpu_scene.h"
#include "samples/gpu_render/trace_pass.h"
#include "samples/render/frame_tracer.h"

namespace walr::gpu_render {

/// Renders the films and references of `walr render` on a GPU, in float. Samples are traced in several dispatches,
/// whose results are added in double.
class FilmTracer final : public render::FrameTracer {
 public:
  /// @param gpu    see `GpuScene`
  /// @param world  must outlive this; may be without ray casting
  FilmTracer(const GpuDevice& gpu, const render::World& world);
  ~FilmTracer() override;

  render::Film film(const render::View& view, const render::SamplingSettings& settings) override;
  walr::Reference reference(const render::View& view, const render::SamplingSettings& settings,
                            const render::ReferenceCoverage& coverage, std::uint64_t& rays) override;

 private:
  class Images;
  struct Sum;

  // Adds the samples of all dispatches.
  Sum trace(const render::View& view, render::SamplingSettings settings, const render::ReferenceCoverage& coverage,
            render::Film* film);

  const GpuDevice& gpu_;
  const render::World& world_;
  GpuScene scene_;
  std::unique_ptr<Images> images_;  // Of the size of the last view.
};

}  // namespace walr::gpu_render
