#include "tests/passes/synthetic_scene.h"

#include <cmath>
#include <limits>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "passes/conventions/orthographic.h"
#include "tests/passes/reference/hash.h"
#include "tests/passes/reference/storage.h"

namespace walr::test {
namespace {

using reference::HostFrame;

constexpr double kFocalLength = 2.0;  // For an image plane of height 2.
constexpr double kBackgroundDepth = 1e10;

/// Distance to the plane through `point`; none behind the camera.
std::optional<double> hitPlane(glm::dvec3 origin, glm::dvec3 direction, glm::dvec3 point, glm::dvec3 normal) {
  const double t = glm::dot(point - origin, normal) / glm::dot(direction, normal);
  if (!(t > 1e-6)) return std::nullopt;
  return t;
}

std::optional<double> hitSphere(glm::dvec3 origin, glm::dvec3 direction, glm::dvec3 centre, double radius) {
  const glm::dvec3 o = origin - centre;
  const double a = glm::dot(direction, direction);
  const double b = glm::dot(o, direction);
  const double discriminant = b * b - a * (glm::dot(o, o) - radius * radius);
  if (discriminant < 0.0) return std::nullopt;
  return (-b - std::sqrt(discriminant)) / a;
}

const glm::dvec3 kWallPoint(0.0, 0.0, -5.0);
const glm::dvec3 kWallNormal = glm::normalize(glm::dvec3(0.3, 0.2, 1.0));
const glm::dvec3 kBackNormal(0.0, 0.0, 1.0);

glm::dvec3 roundToHalf(glm::dvec3 v) {
  return {reference::roundToHalf(v.x), reference::roundToHalf(v.y), reference::roundToHalf(v.z)};
}

double radicalInverse(std::uint32_t index, std::uint32_t base) {
  double value = 0.0;
  for (double digit = 1.0 / base; index > 0; index /= base, digit /= base) value += digit * (index % base);
  return value;
}

}  // namespace

Scene flatWall() {
  return bumpyWall(0.0);
}

Scene wallFacing(glm::dvec3 normal) {
  return [normal](glm::dvec3 origin, glm::dvec3 direction) -> std::optional<SceneHit> {
    const auto t = hitPlane(origin, direction, kWallPoint, normal);
    if (!t) return std::nullopt;
    return SceneHit{*t, normal};
  };
}

Scene bumpyWall(double amplitude) {
  return [amplitude](glm::dvec3 origin, glm::dvec3 direction) -> std::optional<SceneHit> {
    const auto t = hitPlane(origin, direction, kWallPoint, kWallNormal);
    if (!t) return std::nullopt;
    const glm::dvec3 p = origin + *t * direction;
    const glm::dvec3 bump(std::sin(7.0 * p.x + 2.0 * p.y), std::cos(9.0 * p.y - 3.0 * p.x), 0.0);
    return SceneHit{*t, glm::normalize(kWallNormal + amplitude * bump)};
  };
}

Scene sphere() {
  return [](glm::dvec3 origin, glm::dvec3 direction) -> std::optional<SceneHit> {
    const glm::dvec3 centre(0.2, -0.1, -5.0);
    if (const auto t = hitSphere(origin, direction, centre, 1.4)) {
      return SceneHit{*t, glm::normalize(origin + *t * direction - centre)};
    }
    const auto t = hitPlane(origin, direction, {0.0, 0.0, -9.0}, kBackNormal);
    if (!t) return std::nullopt;
    return SceneHit{*t, kBackNormal};
  };
}

Scene thinBars() {
  return [](glm::dvec3 origin, glm::dvec3 direction) -> std::optional<SceneHit> {
    // At this distance an image of 98 x 66 has 13.2 pixels per unit.
    const auto bar = hitPlane(origin, direction, {0.0, 0.0, -5.0}, kBackNormal);
    if (bar) {
      const glm::dvec3 p = origin + *bar * direction;
      const double period = p.x / 0.9 - std::floor(p.x / 0.9);
      if (period < 0.13 && p.y < 1.5) return SceneHit{*bar, kBackNormal};
    }
    const auto wall = hitPlane(origin, direction, {0.0, 0.0, -8.0}, kWallNormal);
    if (!wall) return std::nullopt;
    return SceneHit{*wall, kWallNormal};
  };
}

Scene skyBesideSurface() {
  return [](glm::dvec3 origin, glm::dvec3 direction) -> std::optional<SceneHit> {
    const auto t = hitPlane(origin, direction, kWallPoint, kWallNormal);
    if (!t) return std::nullopt;
    const glm::dvec3 p = origin + *t * direction;
    if (p.x > 0.6 + 0.3 * std::sin(2.0 * p.y)) return std::nullopt;
    const bool diffuse = glm::length(glm::dvec2(p) - glm::dvec2(-1.5, 0.4)) > 0.5;
    return SceneHit{*t, kWallNormal, diffuse};
  };
}

Scene stairs() {
  return [](glm::dvec3 origin, glm::dvec3 direction) -> std::optional<SceneHit> {
    for (int step = -8; step <= 8; ++step) {
      const double height = 0.5 * step;
      // The face of a step, then its tread.
      const double front = -6.0 - 0.4 * step;
      if (const auto t = hitPlane(origin, direction, {0.0, 0.0, front}, kBackNormal)) {
        const glm::dvec3 p = origin + *t * direction;
        if (p.y >= height && p.y < height + 0.5) return SceneHit{*t, kBackNormal};
      }
      const glm::dvec3 up(0.0, 1.0, 0.0);
      if (const auto t = hitPlane(origin, direction, {0.0, height + 0.5, 0.0}, up)) {
        const glm::dvec3 p = origin + *t * direction;
        if (p.z <= front && p.z > front - 0.4) return SceneHit{*t, up};
      }
    }
    return std::nullopt;
  };
}

Scene grazingFloor() {
  return [](glm::dvec3 origin, glm::dvec3 direction) -> std::optional<SceneHit> {
    const glm::dvec3 up(0.0, 1.0, 0.0);
    const auto t = hitPlane(origin, direction, {0.0, -0.15, 0.0}, up);
    if (!t || *t > 200.0) return std::nullopt;
    return SceneHit{*t, up};
  };
}

Scene slidingPanel(std::uint32_t frame) {
  return [frame](glm::dvec3 origin, glm::dvec3 direction) -> std::optional<SceneHit> {
    const auto t = hitPlane(origin, direction, {0.0, 0.0, -5.0}, kBackNormal);
    if (!t) return std::nullopt;
    const glm::dvec3 p = origin + *t * direction;
    const double x = p.x + 1.3 - kPanelStep * frame;
    const bool onPanel = std::abs(x) < 0.8 && std::abs(p.y) < 1.1;
    SceneHit hit{*t, kBackNormal};
    hit.object = onPanel ? 1 : 0;
    hit.moved.x = onPanel ? kPanelStep : 0.0;
    return hit;
  };
}

Scene approachingPanel(std::uint32_t frame, double step) {
  return [frame, step, wall = flatWall()](glm::dvec3 origin, glm::dvec3 direction) -> std::optional<SceneHit> {
    const double z = -4.0 * std::pow(1.0 - step, frame);
    const auto t = hitPlane(origin, direction, {0.0, 0.0, z}, kBackNormal);
    const glm::dvec3 p = t ? origin + *t * direction : glm::dvec3(0.0);
    if (!t || std::abs(p.x) > 0.9 || std::abs(p.y) > 0.7) return wall(origin, direction);
    SceneHit hit{*t, kBackNormal};
    hit.object = 1;
    hit.moved.z = z - z / (1.0 - step);
    return hit;
  };
}

std::vector<NamedScene> allScenes() {
  return {{"flat wall", flatWall()},  {"bumpy wall", bumpyWall(0.1)}, {"sphere", sphere()},
          {"thin bars", thinBars()},  {"sky", skyBesideSurface()},    {"stairs", stairs()},
          {"grazing", grazingFloor()}};
}

glm::dvec3 smoothLight(glm::dvec3 point, glm::dvec3 normal) {
  const double slope = 0.8 + 0.6 * normal.x + 0.4 * normal.y;
  const double place = 1.0 + 0.3 * std::sin(0.7 * point.x) * std::cos(0.5 * point.y);
  return glm::dvec3(0.9, 0.7, 0.5) * (slope * place) + glm::dvec3(0.05, 0.1, 0.2);
}

FrameDescription cameraAt(glm::dvec3 position, glm::dvec3 previousPosition, glm::ivec2 size, std::uint32_t frameIndex) {
  FrameDescription camera;
  camera.view = glm::mat4(glm::translate(glm::dmat4(1.0), -position));
  camera.previousView = glm::mat4(glm::translate(glm::dmat4(1.0), -previousPosition));
  glm::mat4 projection(0.0F);
  projection[0][0] = static_cast<float>(kFocalLength * size.y / size.x);
  projection[1][1] = static_cast<float>(kFocalLength);
  projection[2][2] = -1.0F;
  projection[2][3] = -1.0F;
  projection[3][2] = -0.1F;
  camera.projection = camera.previousProjection = projection;
  camera.frameIndex = frameIndex;
  return camera;
}

FrameDescription orthographicCameraAt(glm::dvec3 position, glm::dvec3 previousPosition, glm::ivec2 size,
                                      std::uint32_t frameIndex, double height) {
  FrameDescription camera = cameraAt(position, previousPosition, size, frameIndex);
  constexpr float kFar = 100.0F;
  glm::mat4 projection(0.0F);
  projection[0][0] = static_cast<float>(2.0 / height * size.y / size.x);
  projection[1][1] = static_cast<float>(2.0 / height);
  // Device depth from 1 at the camera to 0.
  projection[2][2] = 1.0F / kFar;
  projection[3][2] = 1.0F;
  projection[3][3] = 1.0F;
  camera.projection = camera.previousProjection = projection;
  camera.orthographic = true;
  return camera;
}

double noiseOfSample(glm::ivec2 p, std::uint32_t frameIndex) {
  const double uniform = (reference::pcg4d({p, frameIndex, 1000U}).x + 0.5) * 0x1p-32;
  return -std::log(uniform);
}

HostFrame renderFrame(const Scene& scene, const FrameDescription& camera, glm::ivec2 size, const Light& light,
                      Noise noise) {
  HostFrame frame;
  frame.constants = frameConstants(camera, {static_cast<std::uint32_t>(size.x), static_cast<std::uint32_t>(size.y)});
  frame.lighting = frame.normal = frame.motion = frame.albedo = reference::Image<glm::dvec3>(size);
  frame.depth = reference::Image<double>(size, kBackgroundDepth);
  frame.objectId = reference::Image<std::uint32_t>(size, 0xffffffffU);

  const glm::dmat4 view(camera.view);
  const glm::dmat4 world = glm::inverse(view);
  const glm::dvec3 eye(world[3]);
  const glm::dvec4 previousRay(frame.constants.previousRayFromPixel);
  // Rays of an orthographic camera are parallel; those of the constants are its stand-in's.
  const bool orthographic = camera.orthographic;
  const double away = orthographic ? standOff(camera.projection) : 0.0;
  reference::forEachPixel(size, [&](glm::ivec2 p) {
    const glm::dvec3 ray = reference::rayThrough(frame.constants.rayFromPixel, reference::pixelCentre(p));
    const glm::dvec3 origin = orthographic ? eye + glm::dmat3(world) * glm::dvec3(glm::dvec2(ray) * away, 0.0) : eye;
    const glm::dvec3 direction = glm::dmat3(world) * (orthographic ? glm::dvec3(0.0, 0.0, -1.0) : ray);
    const std::optional<SceneHit> hit = scene(origin, direction);
    if (!hit) {
      frame.lighting[p] = roundToHalf({0.3, 0.5, 0.9});
      return;
    }
    const glm::dvec3 point = origin + hit->distance * direction;
    frame.depth[p] = reference::roundToFloat(hit->distance);
    frame.normal[p] = roundToHalf(glm::dmat3(view) * hit->shadingNormal);
    frame.albedo[p] = roundToHalf(hit->diffuse ? glm::dvec3(0.6, 0.5, 0.4) : glm::dvec3(0.0));

    frame.objectId[p] = hit->object;

    const glm::dvec3 before(glm::dmat4(camera.previousView) * glm::dvec4(point - hit->moved, 1.0));
    const glm::dvec2 previousPixel =
        (glm::dvec2(before) / (orthographic ? away : -before.z) - glm::dvec2(previousRay.z, previousRay.w)) /
        glm::dvec2(previousRay);
    frame.motion[p] = roundToHalf(glm::dvec3(previousPixel - reference::pixelCentre(p), -before.z - hit->distance));

    glm::dvec3 radiance = hit->diffuse ? light(point, glm::normalize(hit->shadingNormal)) : glm::dvec3(0.0);
    if (noise == Noise::Exponential) radiance *= noiseOfSample(p, camera.frameIndex);
    frame.lighting[p] = roundToHalf(radiance);
  });
  return frame;
}

HostFrame renderStill(const Scene& scene, glm::ivec2 size, std::uint32_t frameIndex, Noise noise) {
  return renderFrame(scene, cameraAt({}, {}, size, frameIndex), size, smoothLight, noise);
}

HostFrame asSpecular(HostFrame frame, double distance, double roughness) {
  frame.conventions.specular = true;
  frame.lightAlpha = reference::Image<double>(frame.size(), distance);
  frame.roughness = reference::Image<double>(frame.size(), roughness);
  return frame;
}

glm::dvec3 cameraPosition(double time) {
  return {0.09 * time, 0.04 * time, -0.03 * time};
}

void forgetMotionDepth(HostFrame& frame) {
  for (glm::dvec3& motion : frame.motion.pixels()) motion.z = std::numeric_limits<double>::quiet_NaN();
}

std::vector<HostFrame> movingFrames(const Scene& scene, glm::ivec2 size, std::uint32_t count, const Light& light,
                                    Noise noise) {
  std::vector<HostFrame> frames;
  for (std::uint32_t i = 0; i < count; ++i)
    frames.push_back(
        renderFrame(scene, cameraAt(cameraPosition(i), cameraPosition(i - 1.0), size, i), size, light, noise));
  return frames;
}

glm::vec2 jitterAt(std::uint32_t index) {
  const std::uint32_t point = index % 16 + 1;
  return {radicalInverse(point, 2) - 0.5, radicalInverse(point, 3) - 0.5};
}

FrameDescription jittered(FrameDescription camera, std::uint32_t index) {
  camera.jitter = jitterAt(index);
  camera.previousJitter = jitterAt(index + 15);
  return camera;
}

std::vector<HostFrame> jitteredFrames(const Scene& scene, glm::ivec2 size, std::uint32_t count) {
  std::vector<HostFrame> frames;
  for (std::uint32_t i = 0; i < count; ++i) {
    const FrameDescription camera = cameraAt(cameraPosition(i), cameraPosition(i - 1.0), size, i);
    frames.push_back(renderFrame(scene, jittered(camera, i), size));
  }
  return frames;
}

}  // namespace walr::test
