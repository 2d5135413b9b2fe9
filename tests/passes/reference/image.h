#pragma once

#include <vector>

#include <glm/vec2.hpp>

namespace walr::reference {

/// An image in double precision; pixel (0, 0) is at the top left.
template <typename T>
class Image {
 public:
  Image() = default;
  Image(glm::ivec2 size, T fill = {}) : size_(size), pixels_(static_cast<std::size_t>(size.x) * size.y, fill) {}

  [[nodiscard]] glm::ivec2 size() const { return size_; }
  [[nodiscard]] bool contains(glm::ivec2 p) const { return p.x >= 0 && p.y >= 0 && p.x < size_.x && p.y < size_.y; }
  [[nodiscard]] T& operator[](glm::ivec2 p) { return pixels_[index(p)]; }
  [[nodiscard]] const T& operator[](glm::ivec2 p) const { return pixels_[index(p)]; }
  [[nodiscard]] std::vector<T>& pixels() { return pixels_; }
  [[nodiscard]] const std::vector<T>& pixels() const { return pixels_; }

 private:
  [[nodiscard]] std::size_t index(glm::ivec2 p) const { return static_cast<std::size_t>(p.y) * size_.x + p.x; }

  glm::ivec2 size_{0};
  std::vector<T> pixels_;
};

/// Call `visit(p)` for every pixel position of an image, row by row.
template <typename Visit>
void forEachPixel(glm::ivec2 size, Visit visit) {
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) visit(glm::ivec2(x, y));
}

}  // namespace walr::reference
