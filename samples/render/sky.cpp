#include "samples/render/sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include <glm/common.hpp>

namespace walr::render {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// Position in the map, both coordinates in 0..1 (see `SkyMap`).
glm::vec2 placeOf(const glm::vec3& direction) {
  return {0.5F + std::atan2(direction.x, -direction.z) / (2.0F * kPi),
          std::acos(glm::clamp(direction.y, -1.0F, 1.0F)) / kPi};
}

glm::vec3 directionOf(const glm::vec2& place) {
  const float angle = (place.x - 0.5F) * 2.0F * kPi;
  const float polar = place.y * kPi;
  return {std::sin(polar) * std::sin(angle), std::cos(polar), -std::sin(polar) * std::cos(angle)};
}

std::uint32_t texelAt(float place, std::uint32_t size) {
  return std::min(static_cast<std::uint32_t>(std::max(place, 0.0F) * static_cast<float>(size)), size - 1);
}

// Mean of the bilinearly interpolated map over the area of a texel: along each axis the texel has the weight 3/4 and
// each neighbour 1/8.
double lightWithin(const SkyMap& map, std::uint32_t x, std::uint32_t y) {
  constexpr std::array kReach = {0.125, 0.75, 0.125};
  double sum = 0.0;
  for (std::uint32_t dy = 0; dy < kReach.size(); ++dy) {
    const std::uint32_t row = std::clamp(y + dy, 1U, map.height) - 1;
    for (std::uint32_t dx = 0; dx < kReach.size(); ++dx) {
      const std::uint32_t column = (x + dx + map.width - 1) % map.width;
      const glm::vec3& texel = map.radiance[static_cast<std::size_t>(row) * map.width + column];
      sum += kReach.at(dx) * kReach.at(dy) * (static_cast<double>(texel.x) + texel.y + texel.z);
    }
  }
  return sum;
}

// Writes the cumulative distribution of weights, and returns their sum.
double accumulate(std::span<const double> weights, std::span<float> cumulative) {
  double sum = 0.0;
  for (const double weight : weights) {
    sum += weight;
  }
  double until = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    until += weights[i];
    // A row without light gets a uniform distribution, which avoids 0 / 0. Such a row is never chosen.
    cumulative[i] = static_cast<float>(sum > 0.0 ? until / sum : static_cast<double>(i + 1) / weights.size());
  }
  cumulative.back() = 1.0F;
  return sum;
}

float shareOf(std::span<const float> cumulative, std::size_t index) {
  return cumulative[index] - (index > 0 ? cumulative[index - 1] : 0.0F);
}

// Inverts a cumulative distribution: the entry that a number in [0, 1) falls into, and its relative position there.
std::pair<std::size_t, float> pick(std::span<const float> cumulative, float random) {
  const auto found = std::upper_bound(cumulative.begin(), cumulative.end(), random);
  const auto index = static_cast<std::size_t>(std::min(found, cumulative.end() - 1) - cumulative.begin());
  const float before = index > 0 ? cumulative[index - 1] : 0.0F;
  const float share = cumulative[index] - before;
  return {index, share > 0.0F ? (random - before) / share : 0.5F};
}

}  // namespace

Sky::Sky(const Scene& scene) : scene_(scene) {
  if (!scene.skyMap) {
    return;
  }
  const SkyMap& map = *scene.skyMap;
  std::vector<double> rowWeights(map.height);
  std::vector<double> weights(map.width);
  std::vector<float> rows(map.height);
  columns_.resize(static_cast<std::size_t>(map.width) * map.height);
  for (std::uint32_t y = 0; y < map.height; ++y) {
    const std::size_t first = static_cast<std::size_t>(y) * map.width;
    for (std::uint32_t x = 0; x < map.width; ++x) {
      weights[x] = lightWithin(map, x, y);
    }
    const double angle = (y + 0.5) * std::numbers::pi / map.height;
    rowWeights[y] = accumulate(weights, std::span(columns_).subspan(first, map.width)) * std::sin(angle);
  }
  if (accumulate(rowWeights, rows) > 0.0) {
    rows_ = std::move(rows);
  }
}

glm::vec3 Sky::radiance(const glm::vec3& direction) const {
  if (!scene_.skyMap) {
    return scene_.skyRadiance;
  }
  const SkyMap& map = *scene_.skyMap;
  const glm::vec2 place = placeOf(direction) * glm::vec2(map.width, map.height) - 0.5F;
  const glm::vec2 corner = glm::floor(place);
  const glm::vec2 fraction = place - corner;
  const auto texel = [&](int dx, int dy) {
    const auto width = static_cast<int>(map.width);
    const int x = (static_cast<int>(corner.x) + dx + width) % width;
    const int y = std::clamp(static_cast<int>(corner.y) + dy, 0, static_cast<int>(map.height) - 1);
    return map.radiance[static_cast<std::size_t>(y) * map.width + static_cast<std::size_t>(x)];
  };
  return glm::mix(glm::mix(texel(0, 0), texel(1, 0), fraction.x), glm::mix(texel(0, 1), texel(1, 1), fraction.x),
                  fraction.y);
}

SkySample Sky::sample(const glm::vec2& random) const {
  const SkyMap& map = *scene_.skyMap;
  const auto [row, down] = pick(rows_, random.y);
  const auto [column, right] = pick(std::span(columns_).subspan(row * map.width, map.width), random.x);
  SkySample sample;
  sample.direction = directionOf({(static_cast<float>(column) + right) / static_cast<float>(map.width),
                                  (static_cast<float>(row) + down) / static_cast<float>(map.height)});
  sample.radiance = radiance(sample.direction);
  sample.density = density(sample.direction);
  return sample;
}

float Sky::density(const glm::vec3& direction) const {
  if (!isSampled()) {
    return 0.0F;
  }
  const SkyMap& map = *scene_.skyMap;
  const glm::vec2 place = placeOf(direction);
  const std::uint32_t x = texelAt(place.x, map.width);
  const std::uint32_t y = texelAt(place.y, map.height);
  const float share =
      shareOf(rows_, y) * shareOf(std::span(columns_).subspan(static_cast<std::size_t>(y) * map.width, map.width), x);
  // The Jacobian from the map's unit square to solid angle is 2 pi^2 sin(polar angle).
  const float sine = std::sin(place.y * kPi);
  const float texels = static_cast<float>(map.width) * static_cast<float>(map.height);
  return sine > 0.0F ? share * texels / (2.0F * kPi * kPi * sine) : 0.0F;
}

}  // namespace walr::render
