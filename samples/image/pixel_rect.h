#pragma once

#include <glm/common.hpp>
#include <glm/vec2.hpp>

namespace walr {

/// A rectangle of whole pixels, y down.
struct PixelRect {
  glm::ivec2 corner{0};  ///< The upper left pixel.
  glm::ivec2 size{0};

  [[nodiscard]] glm::ivec2 end() const { return corner + size; }  ///< The pixel below and right of the last one.
  bool operator==(const PixelRect&) const = default;
};

/// The smallest rectangle that holds both, neither of which is empty.
inline PixelRect united(const PixelRect& a, const PixelRect& b) {
  const glm::ivec2 corner = glm::min(a.corner, b.corner);
  return {corner, glm::max(a.end(), b.end()) - corner};
}

/// Where an image lies among the pixels of the picture that its renderer was asked for.
struct ImagePlace {
  PixelRect image;    ///< The pixels of the image.
  PixelRect data;     ///< Those of them that have values: the file's data window.
  PixelRect display;  ///< The picture, to which the camera belongs: the file's display window.

  /// Whether all three are the same and begin at the origin.
  [[nodiscard]] bool plain() const { return image.corner == glm::ivec2(0) && image == data && image == display; }
};

}  // namespace walr
