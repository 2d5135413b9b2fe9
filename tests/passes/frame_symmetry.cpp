#include "tests/passes/frame_symmetry.h"

#include <utility>

#include <glm/matrix.hpp>

namespace walr::test {
namespace {

/// The linear map of view space. y points up there and down in the image.
glm::dmat3 viewMap(const Symmetry& s) {
  const glm::dvec3 flip(s.flipX ? -1.0 : 1.0, s.flipY ? -1.0 : 1.0, 1.0);
  glm::dmat3 map(1.0);
  for (int i = 0; i < 3; ++i) map[i] *= flip[i];
  if (!s.transpose) return map;
  // The diagonal of the image runs from the upper left: x goes to -y and y to -x.
  const glm::dmat3 transpose(glm::dvec3(0.0, -1.0, 0.0), glm::dvec3(-1.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, 1.0));
  return transpose * map;
}

glm::vec4 transposeRay(glm::vec4 ray) {
  return {-ray.y, -ray.x, -ray.w, -ray.z};
}

}  // namespace

glm::ivec2 mapPixel(const Symmetry& symmetry, glm::ivec2 p, glm::ivec2 size) {
  if (symmetry.flipX) p.x = size.x - 1 - p.x;
  if (symmetry.flipY) p.y = size.y - 1 - p.y;
  if (symmetry.transpose) std::swap(p.x, p.y);
  return p;
}

reference::HostFrame mapFrame(const Symmetry& symmetry, const reference::HostFrame& frame) {
  const glm::dmat3 map = viewMap(symmetry);
  reference::HostFrame mapped = frame;
  mapped.lighting = mapImage(symmetry, frame.lighting);
  mapped.depth = mapImage(symmetry, frame.depth);
  mapped.albedo = mapImage(symmetry, frame.albedo);
  mapped.normal = mapImage(symmetry, frame.normal);
  for (glm::dvec3& n : mapped.normal.pixels()) n = map * n;
  mapped.motion = mapImage(symmetry, frame.motion);
  for (glm::dvec3& m : mapped.motion.pixels()) {
    if (symmetry.flipX) m.x = -m.x;
    if (symmetry.flipY) m.y = -m.y;
    if (symmetry.transpose) std::swap(m.x, m.y);
  }
  const glm::mat4 map4 = glm::mat4(glm::dmat4(map));
  mapped.constants.previousViewFromView = map4 * frame.constants.previousViewFromView * glm::transpose(map4);
  if (symmetry.transpose) {
    mapped.constants.rayFromPixel = transposeRay(frame.constants.rayFromPixel);
    mapped.constants.previousRayFromPixel = transposeRay(frame.constants.previousRayFromPixel);
    mapped.constants.pixelFromRay = 1.0F / glm::vec2(mapped.constants.rayFromPixel);
    std::swap(mapped.constants.previousTexel.x, mapped.constants.previousTexel.y);
  }
  return mapped;
}

}  // namespace walr::test
