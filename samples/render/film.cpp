#include "samples/render/film.h"

#include <atomic>

#include <glm/geometric.hpp>

#include "samples/render/path_tracer.h"
#include "samples/render/tiles.h"

namespace walr::render {

Film renderFilm(const World& world, const View& view, const SamplingSettings& settings) {
  Film film;
  film.width = view.width;
  film.height = view.height;
  const std::size_t pixels = static_cast<std::size_t>(view.width) * view.height;
  film.gbuffer.resize(pixels);
  film.direct.resize(pixels);
  film.indirect.resize(pixels);
  std::atomic<std::uint64_t> rays = 0;
  forEachTile(view.width, view.height, settings.threads, [&](const Tile& tile) {
    std::uint64_t tileRays = 0;
    for (std::uint32_t y = tile.y0; y < tile.y1; ++y) {
      for (std::uint32_t x = tile.x0; x < tile.x1; ++x) {
        const std::uint32_t index = y * view.width + x;
        const PrimaryHit hit = tracePrimary(world, view, x, y);
        film.gbuffer[index] = hit.pixel;
        ++tileRays;
        if (!hit.surface || hit.pixel.albedo == glm::vec3(0.0F)) {
          continue;
        }
        glm::dvec3 direct(0.0);
        glm::dvec3 indirect(0.0);
        for (std::uint32_t s = 0; s < settings.samples; ++s) {
          Sampler sampler(settings.sampler, settings.seed, (y << 16U) | x, settings.firstSample + s);
          const PathSample path = tracePath(world, *hit.surface, settings.bounces, sampler);
          direct += path.direct;
          indirect += path.indirect;
          tileRays += path.rays;
        }
        film.direct[index] = glm::vec3(direct / static_cast<double>(settings.samples));
        film.indirect[index] = glm::vec3(indirect / static_cast<double>(settings.samples));
      }
    }
    rays += tileRays;
  });
  film.rays = rays;
  return film;
}

}  // namespace walr::render
