#include "passes/conventions/frame.h"

#include <cmath>
#include <stdexcept>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "passes/conventions/camera_check.h"
#include "passes/conventions/orthographic.h"

namespace walr {
namespace {

/// Scale and bias of `ray.xy = pixel * scale + bias` for a pixel position that the given jitter displaces.
glm::dvec4 rayFromPixel(const glm::dmat4& projection, glm::dvec2 jitter, fg::Extent extent) {
  const glm::dvec2 focal(projection[0][0], projection[1][1]);
  // ndc.x = 2 x / width - 1, ndc.y = 1 - 2 y / height, and clip.w = -view.z.
  const glm::dvec2 offCentre(projection[2][0], projection[2][1]);
  const glm::dvec2 scale = glm::dvec2(2.0 / extent.width, -2.0 / extent.height) / focal;
  const glm::dvec2 bias = (glm::dvec2(-1.0, 1.0) + offCentre) / focal + scale * jitter;
  return {scale, bias};
}

/// A perspective camera: the host's, or the stand-in for an orthographic one.
struct Camera {
  glm::dmat4 view;
  glm::dmat4 projection;
};

Camera cameraOf(const glm::mat4& view, const glm::mat4& projection, bool orthographic) {
  if (!orthographic) return {glm::dmat4(view), glm::dmat4(projection)};
  return {standInView(view, projection), standInProjection(projection)};
}

/// Refuse numbers that would silently drop all history or all surfaces.
void checkNumbers(const FrameDescription& frame) {
  const auto finite = [](glm::vec2 v) { return std::isfinite(v.x) && std::isfinite(v.y); };
  if (!finite(frame.jitter) || !finite(frame.previousJitter)) throw std::invalid_argument("the jitter is not finite");
  if (!finite(frame.motionScale)) throw std::invalid_argument("the scale of motion is not finite");
  if (!(frame.skyDepth > 0.0F)) throw std::invalid_argument("the sky's depth is not above 0");
  if (frame.previousExtent && (frame.previousExtent->width == 0 || frame.previousExtent->height == 0)) {
    throw std::invalid_argument("the previous frame has no pixels");
  }
}

}  // namespace

FrameConstants frameConstants(const FrameDescription& frame, fg::Extent extent) {
  checkNumbers(frame);
  for (const glm::mat4& view : {frame.view, frame.previousView}) checkView(view);
  for (const glm::mat4& projection : {frame.projection, frame.previousProjection}) {
    checkProjection(projection, frame.orthographic);
  }
  for (const glm::dvec3& origin : {frame.origin, frame.previousOrigin}) checkOrigin(origin);
  const Camera now = cameraOf(frame.view, frame.projection, frame.orthographic);
  const Camera previous = cameraOf(frame.previousView, frame.previousProjection, frame.orthographic);
  const glm::dvec4 ray = rayFromPixel(now.projection, frame.jitter, extent);
  // The previous frame's jitter and rays, in pixels of this frame.
  const glm::dvec2 size(extent.width, extent.height);
  const fg::Extent previousExtent = frame.previousExtent.value_or(extent);
  const glm::dvec2 previousSize(previousExtent.width, previousExtent.height);
  const glm::dvec2 pixelFromPreviousPixel = size / previousSize;
  const glm::dvec2 previousJitter = glm::dvec2(frame.previousJitter) * pixelFromPreviousPixel;
  const glm::dvec4 previousRay = rayFromPixel(previous.projection, previousJitter, extent);

  FrameConstants constants{};
  constants.viewFromWorld = glm::mat4(now.view);
  // A point relative to the previous origin is the same point relative to this one plus their difference.
  const glm::dmat4 previousFromNow = glm::translate(glm::dmat4(1.0), frame.origin - frame.previousOrigin);
  constants.previousViewFromView = glm::mat4(previous.view * previousFromNow * glm::inverse(now.view));
  constants.rayFromPixel = glm::vec4(ray);
  constants.previousRayFromPixel = glm::vec4(previousRay);
  constants.motionScale = frame.motionScale;
  // A sample's weight falls with its distance from the pixel's centre, and would be negative far outside the pixel.
  constants.jitter = glm::clamp(frame.jitter, -0.5F, 0.5F);
  constants.jitterDelta = glm::vec2(glm::dvec2(frame.jitter) - previousJitter);
  constants.previousPixelFromPixel = glm::vec2(previousSize / size);
  constants.pixelFromPreviousPixel = glm::vec2(pixelFromPreviousPixel);
  constants.previousTexel = glm::vec2(1.0 / previousSize);
  constants.pixelFromRay = glm::vec2(1.0 / ray.x, 1.0 / ray.y);
  constants.frameIndex = frame.frameIndex;
  constants.lightOffset = frame.lightOffset;
  constants.previousLightOffset = frame.previousLightOffset;
  constants.skyDepth =
      frame.orthographic ? static_cast<float>(frame.skyDepth + standOff(frame.projection)) : frame.skyDepth;
  return constants;
}

}  // namespace walr
