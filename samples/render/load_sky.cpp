#include "samples/render/load_sky.h"

#include <cstddef>
#include <string>
#include <vector>

#include "samples/image/exr.h"
#include "samples/render/scene_error.h"

namespace walr::render {

SkyMap loadSky(const std::filesystem::path& file) {
  ExrReader reader(file);
  reader.requireBlocks();
  walr::Image image(reader.width(), reader.height(), 3);
  reader.read(std::vector<ExrReader::Target>{{"R", &image, 0}, {"G", &image, 1}, {"B", &image, 2}});
  SkyMap map;
  map.width = static_cast<std::uint32_t>(image.width());
  map.height = static_cast<std::uint32_t>(image.height());
  map.radiance.reserve(image.pixelCount());
  for (std::size_t i = 0; i < image.pixelCount(); ++i) {
    const auto pixel = image.pixel(i);
    for (const float value : pixel) {
      constexpr float kLargest = 1e9F;
      if (!(value >= 0.0F && value <= kLargest)) {
        throw SceneError(file.string() + ": the radiance at texel (" + std::to_string(i % map.width) + ", " +
                         std::to_string(i / map.width) + ") is not in 0..1e9");
      }
    }
    map.radiance.emplace_back(pixel[0], pixel[1], pixel[2]);
  }
  return map;
}

}  // namespace walr::render
