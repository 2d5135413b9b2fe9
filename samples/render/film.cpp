#include "samples/render/film.h"

#include <atomic>

#include <glm/geometric.hpp>

#include "samples/render/exact/specular.h"
#include "samples/render/path_tracer.h"
#include "samples/render/tiles.h"

namespace walr::render {

namespace {

// The light of one pixel, and the number of rays traced for it.
struct PixelLight {
  glm::dvec3 direct{0.0};
  glm::dvec3 indirect{0.0};
  std::uint64_t rays = 0;
};

class PixelTracer {
 public:
  PixelTracer(const World& world, const SamplingSettings& settings, std::uint32_t bounces, std::uint32_t pixel)
      : world_(world), settings_(settings), bounces_(bounces), pixel_(pixel) {}

  PixelLight diffuse(const Surface& surface) const {
    PixelLight light;
    for (std::uint32_t s = 0; s < settings_.samples; ++s) add(light, trace(surface, s));
    return mean(light);
  }

  // The same with indirect light that is resampled from these paths and from the previous frame.
  PixelLight resampled(const PrimaryHit& hit, Reservoirs& reservoirs, std::uint32_t x, std::uint32_t y) const {
    std::vector<PathSample> paths;
    PixelLight light;
    for (std::uint32_t s = 0; s < settings_.samples; ++s) add(light, paths.emplace_back(trace(*hit.surface, s)));
    light = mean(light);

    Sampler sampler(Sampler::Kind::Independent, settings_.seed ^ kChoiceSeed, pixel_, settings_.firstSample);
    const ResampledLight chosen =
        resample(world_, hit, paths, reservoirs.previous(x, y, hit), reservoirs.mostFrames(), sampler);
    reservoirs.current(x, y) = chosen.reservoir;
    light.indirect = chosen.indirect;
    light.rays += chosen.rays;
    return light;
  }

  // What the specular lobe reflects; without light unless `sampled`. Counts rays.
  SpecularPixel specular(const Surface& surface, bool sampled, std::uint64_t& rays) const {
    SpecularPixel pixel;
    pixel.albedo = specularAlbedo(surface);
    pixel.roughness = surface.roughness;
    if (!sampled) return pixel;
    glm::dvec3 light(0.0);
    double inverseDistance = 0.0;
    glm::dvec3 motion(0.0);
    for (std::uint32_t s = 0; s < settings_.samples; ++s) {
      Sampler sampler(settings_.sampler, settings_.seed ^ exact::kSpecularSeed, pixel_, settings_.firstSample + s);
      const PathSample path = tracePath(world_, surface, bounces_, sampler, Lobe::Specular);
      light += path.direct + path.indirect;
      inverseDistance += 1.0 / path.distance;
      motion += path.motion;
      rays += path.rays;
    }
    pixel.light = glm::vec3(light / static_cast<double>(settings_.samples)) / pixel.albedo;
    pixel.distance = distanceOf(inverseDistance / settings_.samples);
    pixel.motion = glm::vec3(motion / static_cast<double>(settings_.samples));
    return pixel;
  }

 private:
  static constexpr std::uint32_t kChoiceSeed = 0xc401ceU;

  [[nodiscard]] PathSample trace(const Surface& surface, std::uint32_t sample) const {
    Sampler sampler(settings_.sampler, settings_.seed, pixel_, settings_.firstSample + sample);
    return tracePath(world_, surface, bounces_, sampler);
  }
  static void add(PixelLight& light, const PathSample& path) {
    light.direct += path.direct;
    light.indirect += path.indirect;
    light.rays += path.rays;
  }
  [[nodiscard]] PixelLight mean(PixelLight sum) const {
    sum.direct /= static_cast<double>(settings_.samples);
    sum.indirect /= static_cast<double>(settings_.samples);
    return sum;
  }

  const World& world_;
  const SamplingSettings& settings_;
  std::uint32_t bounces_;
  std::uint32_t pixel_;
};

std::uint32_t seedOf(glm::ivec2 pixel) {
  return (static_cast<std::uint32_t>(pixel.y) << 16U) | static_cast<std::uint32_t>(pixel.x);
}

}  // namespace

Film renderFilm(const World& world, const View& view, const SamplingSettings& settings) {
  Film film;
  film.width = view.width;
  film.height = view.height;
  const std::size_t pixels = static_cast<std::size_t>(view.width) * view.height;
  film.gbuffer.resize(pixels);
  film.direct.resize(pixels);
  film.indirect.resize(pixels);
  if (world.scene().specular) film.specular.resize(pixels);
  std::atomic<std::uint64_t> rays = 0;
  forEachTile(
      view.width, view.height, settings.threads,
      [&](const Tile& tile) {
        std::uint64_t tileRays = 0;
        for (std::uint32_t y = tile.y0; y < tile.y1; ++y) {
          for (std::uint32_t x = tile.x0; x < tile.x1; ++x) {
            const std::uint32_t index = y * view.width + x;
            const PrimaryHit hit = tracePrimary(world, view, x, y, settings.gbuffer);
            film.gbuffer[index] = hit.pixel;
            ++tileRays;
            if (!hit.surface) {
              continue;
            }
            const glm::ivec2 pixel(x, y);
            const glm::ivec2 texel = settings.light.texelOf(pixel);
            const bool sampled = settings.light.hasSample(pixel, settings.lightOffset);
            const PixelTracer tracer(world, settings, sampled ? settings.bounces : 0,
                                     sampled ? seedOf(texel) : seedOf(pixel));
            if (!film.specular.empty()) {
              film.specular[index] = tracer.specular(*hit.surface, sampled, tileRays);
              film.specular[index].albedo *= hit.tint;
              film.specular[index].motion = hit.imageFromWorld * film.specular[index].motion;
            }
            if (hit.pixel.albedo == glm::vec3(0.0F)) {
              continue;
            }
            const PixelLight light =
                settings.reservoirs ? tracer.resampled(hit, *settings.reservoirs, x, y) : tracer.diffuse(*hit.surface);
            film.direct[index] = glm::vec3(light.direct);
            if (sampled) film.indirect[index] = glm::vec3(light.indirect);
            tileRays += light.rays;
          }
        }
        rays += tileRays;
      },
      settings.pixelsDone);
  if (settings.reservoirs) settings.reservoirs->nextFrame();
  film.rays = rays;
  return film;
}

}  // namespace walr::render
