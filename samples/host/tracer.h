#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "framegraph/declare/graph.h"
#include "passes/conventions/light_pattern.h"
#include "samples/gpu_render/gpu_scene.h"
#include "samples/host/host_frame.h"
#include "samples/host/traced_rays.h"
#include "samples/render/film.h"
#include "samples/render/gbuffer.h"
#include "samples/render/resampling.h"
#include "samples/render/scene.h"
#include "samples/render/world.h"
#include "samples/sequence/frame.h"

namespace walr::host {

/// Produces the host's frames from a scene, its animation and a path tracer. The path tracer runs on the processor, or
/// as a pass of the host's graph.
class Tracer {
 public:
  struct Options {
    std::filesystem::path scene;
    std::filesystem::path sky;  ///< Equirectangular sky that replaces the scene's; may be empty.
    fg::Extent extent;
    std::uint32_t samples = 1;  ///< Samples per pixel.
    /// Pixels with a sample of indirect light; which they are changes from frame to frame (`lightOffsetOfFrame`).
    LightPattern light = {};
    std::uint32_t referenceSamples = 1;  ///< Samples per pixel that each frame adds to the reference.
    std::uint32_t bounces = 4;
    std::uint32_t seed = 0;
    double framesPerSecond = 24.0;
    std::string camera;   ///< Name of the camera or of its node; empty: the first.
    bool jitter = false;  ///< Offset the sample position from the pixel centre by `render::haltonJitter`.
    render::GBufferMode gbuffer = render::GBufferMode::FirstHit;
    /// Add the direct light to the indirect light, so that both are denoised. The direct light is then 0. Otherwise the
    /// direct light is shown as it was traced: one sample per pixel of a lamp or of the sky is noisy.
    bool denoiseDirect = true;
    bool specular = false;  ///< See `render::Scene::specular`; frames and references then hold specular light.
    unsigned int threads = 0;
  };

  /// What to trace.
  struct Request {
    int number = 0;               ///< Frame number: selects the random numbers and the jitter.
    double animationFrame = 0.0;  ///< Time of the animation, in frames.
    /// The camera, world to view space; nullopt: the scene's.
    std::optional<glm::mat4> view = std::nullopt;
    /// Size of the picture; nullopt: `Options::extent`. The field of view is that of `Options::extent` in any case, so
    /// that the size may change from frame to frame.
    std::optional<fg::Extent> extent = std::nullopt;
    bool cut = false;           ///< Camera cut: nothing is carried over from the previous frame.
    bool resetHistory = false;  ///< Nothing is carried over from the previous frame, without a camera cut.
    bool reference = false;     ///< Add a reference: the mean of all samples since the image last changed.
    /// Frames before this one whose samples of indirect light are used again (`render::resample`), at most; 0: none.
    /// They are dropped wherever the history is, and where this number or the size of the picture changes.
    std::uint32_t resampledFrames = 0;
  };

  /// @param gpu  traces the frames, must outlive this (see `gpu_render::GpuScene`); null: the processor does
  /// @throws render::SceneError for a scene that cannot be rendered
  explicit Tracer(const Options& options, const GpuDevice* gpu = nullptr);

  /// A scene in the processor's memory, and what a device needs of it.
  struct Content {
    /// For errors see the constructor of `Tracer`.
    /// @param onDevice  a device traces it, see `prepare`
    Content(const Options& options, bool onDevice);
    /// Make what a device needs to trace it. This uses the device's queue.
    void prepare(const GpuDevice& gpu);

    render::Scene scene;
    std::uint32_t camera;
    render::World world;
    glm::vec4 bounds;                                        ///< See `Tracer::bounds`.
    std::unique_ptr<gpu_render::GpuScene> device = nullptr;  ///< Null if the processor traces, and before `prepare`.
    std::optional<float> exposure = std::nullopt;            ///< At the start of the animation; see `Tracer::exposure`.
  };

  /// Read another scene to be traced with the same options, seen by its first camera. Other threads may use the tracer
  /// meanwhile.
  /// @throws as the constructor
  [[nodiscard]] std::unique_ptr<Content> read(const std::filesystem::path& file) const;
  /// Trace a scene that was read. The next frame has no previous one.
  /// @throws as the constructor; then nothing has changed
  void show(std::unique_ptr<Content> content);

  [[nodiscard]] fg::Extent extent() const { return options_.extent; }
  [[nodiscard]] bool denoisesDirect() const { return options_.denoiseDirect; }
  /// Whether frames hold specular light.
  [[nodiscard]] bool specular() const { return options_.specular; }
  /// See `render::Scene::warnings`.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return content_->scene.warnings; }
  [[nodiscard]] const LightPattern& light() const { return options_.light; }
  /// Why `Request::resampledFrames` must be 0; empty if it need not.
  [[nodiscard]] std::string whyNotResampled() const;
  /// Pose of the scene's camera in a frame of the animation: world to view space.
  [[nodiscard]] glm::mat4 sceneCamera(double animationFrame) const;
  /// Number of the frame that is nearest to the animation's end; 0 for a static scene.
  [[nodiscard]] int lastAnimationFrame() const;
  /// Centre (x, y, z) and radius (w) of a bounding sphere of the scene at the start of its animation, in scene units.
  [[nodiscard]] glm::vec4 bounds() const { return content_->bounds; }

  /// Exposure in stops for what the scene's camera shows in a frame of the animation: `autoExposure` of a small
  /// picture; 0 if that is black.
  [[nodiscard]] float exposure(double animationFrame);

  /// What `declareHostGraph` traces; null if the processor traces.
  [[nodiscard]] const gpu_render::GpuScene* gpuScene() const { return content_->device.get(); }

  /// Trace a frame on the processor. Its previous frame is that of the previous call.
  /// @throws std::invalid_argument for samples that are to be used again but cannot, see `whyNotResampled`
  Frame trace(const Request& request);
  /// The rays of the last frame that the processor traced, with those of its reference.
  [[nodiscard]] const TracedRays& traced() const { return traced_; }
  /// The next frame for the host's graph: traced, or what the device needs to trace it.
  /// @throws see `trace`
  HostFrame hostFrame(const Request& request);

 private:
  /// Sum of the reference samples of one image.
  struct Accumulation {
    double animationFrame = 0.0;
    render::View view;
    std::vector<glm::dvec3> indirect;
    std::vector<glm::dvec3> direct;
    std::vector<glm::dvec3> specular;  ///< Empty without specular light.
    std::uint32_t steps = 0;
  };

  /// Moves the scene to a frame. Returns its view.
  render::View moveTo(const Request& request);
  /// Traces on the processor, and adds to `traced_`.
  render::Film renderFilm(const render::View& view, const render::SamplingSettings& sampling);
  [[nodiscard]] fg::Extent extentOf(const Request& request) const { return request.extent.value_or(options_.extent); }
  [[nodiscard]] glm::ivec2 lightOffset(const Request& request) const;
  [[nodiscard]] render::View viewOf(const Request& request) const;
  render::SamplingSettings samplingOf(const Request& request);
  /// The samples that a frame uses again and keeps for the next one; null if it does neither.
  render::Reservoirs* reservoirsFor(const Request& request);
  /// To be called for every frame, in the end.
  void finish(const Request& request, const render::View& view, Frame& frame);
  Reference traceReference(const Request& request, const render::View& view);

  /// The exposure of a scene that is not being traced.
  [[nodiscard]] float exposureOf(Content& content, double animationFrame) const;

  Options options_;
  const GpuDevice* gpu_;
  std::unique_ptr<Content> content_;
  std::optional<Request> previous_;
  glm::mat4 previousView_{1.0F};
  std::optional<render::Reservoirs> reservoirs_;  // Of the previous frame; none if that was not resampled.
  Accumulation reference_;
  TracedRays traced_;
};

}  // namespace walr::host
