#include "samples/render/image_decode.h"

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include <stb_image.h>

#include "samples/render/scene_error.h"

namespace walr::render {
namespace {

// stb_image reads more formats than glTF allows. They are refused, because their decoders are little tested.
bool isPngOrJpeg(std::span<const std::uint8_t> bytes) {
  constexpr std::array<std::uint8_t, 4> kPng = {0x89, 'P', 'N', 'G'};
  constexpr std::array<std::uint8_t, 3> kJpeg = {0xff, 0xd8, 0xff};
  const auto startsWith = [&](const auto& signature) {
    return bytes.size() >= signature.size() && std::ranges::equal(bytes.first(signature.size()), signature);
  };
  return startsWith(kPng) || startsWith(kJpeg);
}

}  // namespace

Image decodeImage(std::span<const std::uint8_t> bytes, std::uint64_t& texelBudget) {
  constexpr int kLargestSide = 16384;
  const int size = static_cast<int>(bytes.size());
  int width = 0;
  int height = 0;
  int components = 0;
  if (!isPngOrJpeg(bytes)) {
    throw SceneError("not a PNG or JPEG image");
  }
  if (stbi_info_from_memory(bytes.data(), size, &width, &height, &components) == 0) {
    throw SceneError(std::string("cannot be read: ") + stbi_failure_reason());
  }
  const std::string dimensions = std::to_string(width) + " x " + std::to_string(height) + " texels";
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide) {
    throw SceneError("has " + dimensions + "; the limit is " + std::to_string(kLargestSide) + " a side");
  }
  const auto texels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  if (texels > texelBudget) {
    throw SceneError("has " + dimensions + ", which exceeds the limit for all textures together");
  }
  constexpr int kRgba = 4;
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> decoded(
      stbi_load_from_memory(bytes.data(), size, &width, &height, &components, kRgba), &stbi_image_free);
  if (!decoded) {
    throw SceneError(std::string("cannot be decoded: ") + stbi_failure_reason());
  }
  texelBudget -= texels;
  Image image;
  image.width = static_cast<std::uint32_t>(width);
  image.height = static_cast<std::uint32_t>(height);
  image.rgba.assign(decoded.get(), decoded.get() + texels * kRgba);
  return image;
}

}  // namespace walr::render
