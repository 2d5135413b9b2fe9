#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace walr {

/// An image of interleaved 32-bit floats, rows from the top.
class Image {
 public:
  Image() = default;
  Image(int width, int height, int components)
      : width_(width),
        height_(height),
        components_(components),
        values_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                static_cast<std::size_t>(components)) {}

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int components() const { return components_; }
  [[nodiscard]] bool empty() const { return values_.empty(); }
  [[nodiscard]] std::size_t pixelCount() const {
    return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  }

  /// All values, pixel by pixel.
  [[nodiscard]] std::span<float> values() { return values_; }
  [[nodiscard]] std::span<const float> values() const { return values_; }
  /// The components of pixel number `index` = y * width + x.
  [[nodiscard]] std::span<float> pixel(std::size_t index) { return values().subspan(index * stride(), stride()); }
  [[nodiscard]] std::span<const float> pixel(std::size_t index) const {
    return values().subspan(index * stride(), stride());
  }
  [[nodiscard]] float& at(int x, int y, int component) { return values_[offset(x, y, component)]; }
  [[nodiscard]] float at(int x, int y, int component) const { return values_[offset(x, y, component)]; }

 private:
  [[nodiscard]] std::size_t stride() const { return static_cast<std::size_t>(components_); }
  [[nodiscard]] std::size_t offset(int x, int y, int component) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)) * stride() +
           static_cast<std::size_t>(component);
  }

  int width_ = 0;
  int height_ = 0;
  int components_ = 0;
  std::vector<float> values_;
};

}  // namespace walr
