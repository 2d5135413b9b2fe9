#include "samples/render/reference.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "samples/render/exact/specular.h"
#include "samples/render/path_tracer.h"
#include "samples/render/tiles.h"

namespace walr::render {
namespace {

struct LightSum {
  glm::dvec3 direct{0.0};
  glm::dvec3 indirect{0.0};
  glm::dvec3 specular{0.0};
  std::uint32_t paths = 0;
  std::uint32_t specularPaths = 0;

  LightSum& operator+=(const LightSum& other) {
    direct += other.direct;
    indirect += other.indirect;
    specular += other.specular;
    paths += other.paths;
    specularPaths += other.specularPaths;
    return *this;
  }
  [[nodiscard]] glm::dvec3 mean(const glm::dvec3& sum) const { return sum / std::max(static_cast<double>(paths), 1.0); }
  [[nodiscard]] glm::dvec3 meanSpecular() const { return specular / std::max(static_cast<double>(specularPaths), 1.0); }
};

bool diffuse(const PrimaryHit& hit) {
  return hit.surface && hit.pixel.albedo != glm::vec3(0.0F);
}

class ReferenceTracer {
 public:
  ReferenceTracer(const World& world, const View& view, const SamplingSettings& settings, bool wholePixel)
      : world_(world), view_(view), settings_(settings), wholePixel_(wholePixel), specular_(world.scene().specular) {}

  // Adds up samples of one half; the two halves use different random sequences.
  LightSum trace(std::uint32_t x, std::uint32_t y, std::uint32_t half, std::uint32_t paths, std::uint64_t& rays) const {
    LightSum sum;
    PrimaryHit hit;
    if (!wholePixel_) {
      hit = tracePrimary(world_, view_, x, y, settings_.gbuffer);
      ++rays;
      if (!lit(hit)) return sum;
    }
    const std::uint32_t seed = half == 0 ? settings_.seed : seedOfSecondHalf(settings_.seed);
    const std::uint32_t pixel = (y << 16U) | x;
    for (std::uint32_t s = 0; s < paths; ++s) {
      Sampler sampler(settings_.sampler, seed, pixel, settings_.firstSample + s);
      if (wholePixel_) {
        View view = view_;
        view.jitter = sampler.next2D() - 0.5F;
        hit = tracePrimary(world_, view, x, y, settings_.gbuffer);
        ++rays;
        if (!lit(hit)) continue;
      }
      if (specular_) {
        Sampler other(settings_.sampler, seed ^ exact::kSpecularSeed, pixel, settings_.firstSample + s);
        const PathSample path = tracePath(world_, *hit.surface, settings_.bounces, other, Lobe::Specular);
        sum.specular += (path.direct + path.indirect) / specularAlbedo(*hit.surface);
        ++sum.specularPaths;
        rays += path.rays;
        if (!diffuse(hit)) continue;
      }
      const PathSample path = tracePath(world_, *hit.surface, settings_.bounces, sampler);
      sum.direct += path.direct;
      sum.indirect += path.indirect;
      ++sum.paths;
      rays += path.rays;
    }
    return sum;
  }

 private:
  [[nodiscard]] bool lit(const PrimaryHit& hit) const { return specular_ ? hit.surface.has_value() : diffuse(hit); }

  const World& world_;
  const View& view_;
  const SamplingSettings& settings_;
  bool wholePixel_;
  bool specular_;
};

void set(walr::Image& image, std::size_t index, const glm::dvec3& value) {
  for (int c = 0; c < 3; ++c) image.pixel(index)[static_cast<std::size_t>(c)] = static_cast<float>(value[c]);
}

}  // namespace

std::uint32_t ReferenceCoverage::rowShift() const {
  constexpr double kGolden = 0.6180339887498949;
  return static_cast<std::uint32_t>(std::lround(kGolden * oneSquareIn));
}

bool ReferenceCoverage::covers(std::uint32_t x, std::uint32_t y) const {
  constexpr std::uint32_t kSide = 64;
  return (x / kSide + rowShift() * (y / kSide)) % oneSquareIn == 0;
}

walr::Reference renderReference(const World& world, const View& view, const SamplingSettings& settings,
                                const ReferenceCoverage& coverage, std::uint64_t& rays) {
  const auto image = [&] { return walr::Image(static_cast<int>(view.width), static_cast<int>(view.height), 3); };
  const bool inHalves = settings.samples % 2 == 0;
  walr::Reference reference{image(), image(), inHalves ? image() : walr::Image()};
  const bool specular = world.scene().specular;
  if (specular) reference.specular = image();
  if (specular && inHalves) reference.specularHalf = image();
  const ReferenceTracer tracer(world, view, settings, coverage.wholePixel);
  std::atomic<std::uint64_t> allRays = 0;
  forEachTile(
      view.width, view.height, settings.threads,
      [&](const Tile& tile) {
        std::uint64_t tileRays = 0;
        for (std::uint32_t y = tile.y0; y < tile.y1; ++y) {
          for (std::uint32_t x = tile.x0; x < tile.x1; ++x) {
            const std::size_t index = static_cast<std::size_t>(y) * view.width + x;
            if (!coverage.covers(x, y)) {
              const glm::dvec3 nothing(std::numeric_limits<double>::quiet_NaN());
              set(reference.direct, index, nothing);
              set(reference.indirect, index, nothing);
              if (inHalves) set(reference.indirectHalf, index, nothing);
              if (specular) set(reference.specular, index, nothing);
              if (specular && inHalves) set(reference.specularHalf, index, nothing);
              continue;
            }
            LightSum sum = tracer.trace(x, y, 0, inHalves ? settings.samples / 2 : settings.samples, tileRays);
            if (inHalves) {
              const LightSum first = sum;
              sum += tracer.trace(x, y, 1, settings.samples / 2, tileRays);
              // Where one half met no diffuse surface, the two say nothing of each other.
              const bool both = first.paths > 0 && first.paths < sum.paths;
              set(reference.indirectHalf, index, both ? first.mean(first.indirect) : sum.mean(sum.indirect));
              const bool bothSpecular = first.specularPaths > 0 && first.specularPaths < sum.specularPaths;
              if (specular) set(reference.specularHalf, index, (bothSpecular ? first : sum).meanSpecular());
            }
            set(reference.direct, index, sum.mean(sum.direct));
            set(reference.indirect, index, sum.mean(sum.indirect));
            if (specular) set(reference.specular, index, sum.meanSpecular());
          }
        }
        allRays += tileRays;
      },
      settings.pixelsDone);
  rays = allRays;
  return reference;
}

}  // namespace walr::render
