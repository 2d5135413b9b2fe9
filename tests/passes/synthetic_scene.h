#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "passes/conventions/frame.h"
#include "tests/passes/reference/frame.h"

/// Small analytic scenes with their G-buffers, for tests of the passes.
namespace walr::test {

/// The point at which a ray meets a surface.
struct SceneHit {
  double distance = 0.0;          ///< In units of the length of the ray's direction.
  glm::dvec3 shadingNormal{0.0};  ///< World space; need not be unit.
  bool diffuse = true;            ///< False for black metal, glass, emitters: albedo 0.
  std::uint32_t object = 0;       ///< Number of the object.
  glm::dvec3 moved{0.0};          ///< Movement since the previous frame, world space.
};

/// A world: the first hit of a ray from `origin` along `direction`; none for sky.
using Scene = std::function<std::optional<SceneHit>(glm::dvec3 origin, glm::dvec3 direction)>;

/// A tilted wall.
Scene flatWall();
/// A wall with this unit normal.
Scene wallFacing(glm::dvec3 normal);
/// The same wall with shading normals that vary by the given amplitude.
Scene bumpyWall(double amplitude);
/// A sphere in front of a wall.
Scene sphere();
/// Bars 1.5 pixels wide (in an image 96 pixels wide) in front of a wall.
Scene thinBars();
/// A wall that ends in the middle of the image, with sky behind it and a patch on it without a diffuse lobe.
Scene skyBesideSurface();
/// Stairs, seen from the front.
Scene stairs();
/// A floor seen at a grazing angle.
Scene grazingFloor();

/// A wall and, in its plane, a panel that slides to the right by `kPanelStep` per frame.
Scene slidingPanel(std::uint32_t frame);
inline constexpr double kPanelStep = 0.5;

/// A panel that faces the camera in front of a wall, and comes nearer by the share `step` of its distance per frame.
Scene approachingPanel(std::uint32_t frame, double step);

/// All of the scenes above that stand still, with their names.
struct NamedScene {
  const char* name;
  Scene scene;
};
std::vector<NamedScene> allScenes();

/// Radiance that leaves a point of a surface.
using Light = std::function<glm::dvec3(glm::dvec3 point, glm::dvec3 normal)>;
/// Smooth light that varies with position and normal, between about 0.2 and 2.
glm::dvec3 smoothLight(glm::dvec3 point, glm::dvec3 normal);

/// Noise of the lighting samples.
enum class Noise {
  None,
  Exponential,  ///< Relative standard deviation 1, as at one sample per pixel.
};

/// The factor of `Noise::Exponential` for a pixel's sample in a frame, from a hash.
double noiseOfSample(glm::ivec2 p, std::uint32_t frameIndex);

/// A camera at `position` that looks down -Z; field of view 53 degrees across the height.
FrameDescription cameraAt(glm::dvec3 position, glm::dvec3 previousPosition, glm::ivec2 size, std::uint32_t frameIndex);

/// Position at a time, in frames, of a camera that moves by about a pixel and a half a frame.
glm::dvec3 cameraPosition(double time);

/// The same as `cameraAt` with an orthographic camera whose image is `height` scene units high.
FrameDescription orthographicCameraAt(glm::dvec3 position, glm::dvec3 previousPosition, glm::ivec2 size,
                                      std::uint32_t frameIndex, double height);

/// Render a frame; every value is rounded to the format of its texture.
reference::HostFrame renderFrame(const Scene& scene, const FrameDescription& camera, glm::ivec2 size,
                                 const Light& light = smoothLight, Noise noise = Noise::Exponential);

/// Render a frame of a still camera.
reference::HostFrame renderStill(const Scene& scene, glm::ivec2 size, std::uint32_t frameIndex = 0,
                                 Noise noise = Noise::Exponential);
/// The frame as one of specular light: all pixels have this roughness, and reflect what lies at this distance.
reference::HostFrame asSpecular(reference::HostFrame frame, double distance, double roughness);

/// Makes the change of depth NaN, which must not be read where motion has no depth.
void forgetMotionDepth(reference::HostFrame& frame);

/// The first frames of the camera of `cameraPosition`.
std::vector<reference::HostFrame> movingFrames(const Scene& scene, glm::ivec2 size, std::uint32_t count = 3,
                                               const Light& light = smoothLight, Noise noise = Noise::Exponential);

/// Jitter about the pixel's centre: 16 points of the Halton sequences of bases 2 and 3 (Halton 1960), over and over.
glm::vec2 jitterAt(std::uint32_t index);
/// A camera with the jitter of the given frame.
FrameDescription jittered(FrameDescription camera, std::uint32_t index);
/// Frames of `movingFrames`, jittered.
std::vector<reference::HostFrame> jitteredFrames(const Scene& scene, glm::ivec2 size, std::uint32_t count = 3);

}  // namespace walr::test
