/// Computes FLIP with its authors' own implementation (FLIP.h, version 1.6 of https://github.com/NVlabs/flip).
///
///     make_flip_fixture FILE            writes the values to FILE (flip_fixture.json)
///     make_flip_fixture --check FILE    fails if FILE differs from what would be written
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <FLIP.h>
#include <nlohmann/json.hpp>

#include "samples/metrics/display.h"
#include "tests/samples/metric_pictures.h"

namespace {

struct Case {
  const char* name;
  int width;
  int height;
  double amplitude;
  float pixelsPerDegree;
};

constexpr Case kCases[] = {
    {"odd_size", 37, 29, 0.3, 67.02064F}, {"strong_noise", 64, 40, 3.0, 67.02064F}, {"close", 96, 54, 0.5, 20.0F}};
// The fixture holds every 29th pixel.
constexpr std::size_t kStride = 29;

nlohmann::ordered_json measure(const Case& c) {
  const walr::test::Pictures pictures = walr::test::makePictures(c.width, c.height, c.amplitude);
  const walr::DisplayedPair pair =
      walr::display(pictures.test, pictures.reference, walr::PixelMask(pictures.reference.pixelCount(), 1));
  FLIP::Parameters parameters;
  parameters.PPD = c.pixelsPerDegree;
  float mean = 0.0F;
  float* map = nullptr;
  FLIP::evaluate(pair.reference.values().data(), pair.test.values().data(), c.width, c.height, false, parameters, false,
                 true, mean, &map);
  const std::unique_ptr<float[]> owned(map);
  std::vector<float> values;
  for (std::size_t i = 0; i < pair.reference.pixelCount(); i += kStride) values.push_back(map[i]);
  return {{"name", c.name},
          {"width", c.width},
          {"height", c.height},
          {"amplitude", c.amplitude},
          {"pixels_per_degree", c.pixelsPerDegree},
          {"mean", mean},
          {"stride", kStride},
          {"values", values}};
}

}  // namespace

int main(int argc, char** argv) {
  const bool check = argc == 3 && std::string(argv[1]) == "--check";
  if (argc != 2 && !check) {
    std::cerr << "usage: make_flip_fixture [--check] FILE\n";
    return 2;
  }
  nlohmann::ordered_json cases;
  for (const Case& c : kCases) cases.push_back(measure(c));
  const std::string text = cases.dump(1) + "\n";
  if (!check) {
    std::ofstream(argv[1]) << text;
    return 0;
  }
  std::ifstream stream(argv[2]);
  if (std::string(std::istreambuf_iterator<char>(stream), {}) == text) return 0;
  std::cerr << argv[2] << " differs from the values that FLIP.h computes\n";
  return 1;
}
