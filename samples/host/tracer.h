#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "framegraph/declare/graph.h"
#include "samples/render/film.h"
#include "samples/render/gbuffer.h"
#include "samples/render/scene.h"
#include "samples/render/world.h"
#include "samples/sequence/frame.h"

namespace walr::host {

/// Makes the host's frames: a scene, its animation and a path tracer.
class Tracer {
 public:
  struct Options {
    std::filesystem::path scene;
    std::filesystem::path sky;  ///< Equirectangular sky in place of the scene's; may be empty.
    fg::Extent extent;
    std::uint32_t samples = 1;           ///< Samples per pixel.
    std::uint32_t referenceSamples = 1;  ///< Samples per pixel of one step of a reference.
    std::uint32_t bounces = 4;
    std::uint32_t seed = 0;
    double framesPerSecond = 24.0;
    std::string camera;   ///< Name of the camera or of its node; empty: the first.
    bool jitter = false;  ///< Sample off the pixel centre, by `render::haltonJitter`.
    render::GBufferMode gbuffer = render::GBufferMode::FirstHit;
    bool denoiseDirect = false;  ///< Count the direct light among what is denoised, and leave none beside it.
    unsigned int threads = 0;
  };

  /// What to trace.
  struct Request {
    int number = 0;               ///< Counts frames: picks the random numbers and the jitter.
    double animationFrame = 0.0;  ///< Where the animation stands, in frames.
    /// The camera, world to view space; nothing: the scene's.
    std::optional<glm::mat4> view = std::nullopt;
    bool cut = false;           ///< The camera jumps: nothing is carried over from the frame before.
    bool resetHistory = false;  ///< Nothing is carried over, though the camera does not jump.
    bool reference = false;     ///< With a reference: the mean of all since the picture last changed.
  };

  /// @throws render::SceneError for a scene that cannot be rendered
  explicit Tracer(const Options& options);

  /// What of the scene is not supported or had to be replaced.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return scene_.warnings; }
  /// Where the scene's camera stands in a frame of the animation: world to view space.
  [[nodiscard]] glm::mat4 sceneCamera(double animationFrame) const;
  /// Number of the animation's last frame; 0 for a scene that stands still.
  [[nodiscard]] double lastAnimationFrame() const;
  /// Centre and radius of a sphere around everything.
  [[nodiscard]] glm::vec4 bounds() const;

  /// Trace a frame. The frame before it is the one traced by the call before.
  Frame trace(const Request& request);

 private:
  /// Sum of the references of one picture.
  struct Accumulation {
    double animationFrame = 0.0;
    render::View view;
    std::vector<glm::dvec3> indirect;
    std::vector<glm::dvec3> direct;
    std::uint32_t steps = 0;
  };

  [[nodiscard]] render::View viewOf(const Request& request) const;
  Reference traceReference(const Request& request, const render::View& view);

  Options options_;
  render::Scene scene_;
  std::uint32_t camera_;
  render::World world_;
  std::optional<Request> previous_;
  glm::mat4 previousView_{1.0F};
  Accumulation reference_;
};

}  // namespace walr::host
