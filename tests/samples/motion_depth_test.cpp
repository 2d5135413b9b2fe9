// The table "Motion without depth" of the integration guide: what it costs to find or to leave out the change of depth
// of moving objects, measured on the built-in scene `turntable`.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "samples/denoise/gpu_denoiser.h"
#include "samples/metrics/metrics.h"
#include "samples/render/render_sequence.h"
#include "samples/sequence/sequence.h"
#include "tests/guide_table.h"
#include "tests/samples/temporary_directory.h"

namespace walr::test {
namespace {

using MotionDepth = InputConventions::MotionDepth;

constexpr int kFrames = 12;
constexpr std::size_t kBuiltUp = 4;  // Frames until history has built up.

/// What a source of the change of depth gives, over the frames after the fourth.
struct Result {
  double withoutHistory = 0.0;  ///< Pixels that start without history, a frame.
  std::vector<Image> pictures;
};

double counterOf(const DenoisedPicture& picture, std::string_view name) {
  for (const CounterValue& counter : picture.counters)
    if (counter.name == name) return double(counter.value);
  ADD_FAILURE() << "no counter " << name;
  return 0.0;
}

/// @param pipelines of the device; creating them takes longest
Result denoised(const GpuDevice& device, const fg::vk::Membership& pipelines, const std::filesystem::path& folder,
                MotionDepth source) {
  SequenceOptions options;
  options.motionDepth = source;
  const Sequence sequence(folder, options);
  const auto method = makeDenoiser("walr");
  GpuDenoiser denoiser(device, *method, sequence.extent(), sequence.denoiserLayout(), {.counters = true}, 1, {},
                       pipelines);
  Result result;
  for (std::size_t i = 0; i < sequence.entries().size(); ++i) {
    PackedFrame frame = packFrame(sequence.read(i));
    if (source != MotionDepth::Given)
      for (Rgba16& motion : frame.motion) motion[2] = 0x7e00;
    DenoisedPicture picture = denoiser.run(frame);
    if (i < kBuiltUp) continue;
    result.withoutHistory += counterOf(picture, "no-history") / double(kFrames - kBuiltUp);
    result.pictures.push_back(std::move(picture.lights.front()));
  }
  return result;
}

/// Root mean square difference after the tone map x / (1 + x).
double difference(const Result& a, const Result& b) {
  double sum = 0.0;
  double values = 0.0;
  for (std::size_t i = 0; i < a.pictures.size(); ++i) {
    for (std::size_t j = 0; j < a.pictures[i].values().size(); ++j) {
      const double x = a.pictures[i].values()[j];
      const double y = b.pictures[i].values()[j];
      sum += std::pow(x / (1.0 + x) - y / (1.0 + y), 2.0);
      values += 1.0;
    }
  }
  return std::sqrt(sum / values);
}

const std::string kHeading =
    "| frames per second | pixels without history in a frame: depth given | still scene | depth found "
    "| difference from depth given: still scene | depth found |\n"
    "| --- | --- | --- | --- | --- | --- |\n";

using Row = std::array<double, 6>;  ///< The numbers of a row of the guide's table.

std::string textOf(const Row& row) {
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(), "| %.0f | %.0f | %.0f | %.0f | %.1f | %.1f |\n", row[0], row[1], row[2],
                row[3], row[4], row[5]);
  return text.data();
}

/// The rows of a table with this heading. A number that cannot be read is 0.
std::vector<Row> rowsOf(const std::string& table) {
  EXPECT_EQ(table.substr(0, kHeading.size()), kHeading);
  std::istringstream lines(table.substr(std::min(kHeading.size(), table.size())));
  std::vector<Row> rows;
  for (std::string line; std::getline(lines, line);) {
    Row& row = rows.emplace_back();
    std::sscanf(line.c_str(), "| %lf | %lf | %lf | %lf | %lf | %lf |", row.data(), &row[1], &row[2], &row[3], &row[4],
                &row[5]);
  }
  return rows;
}

TEST(MotionDepth, TheGuideTellsWhatFindingItCosts) {
  const TemporaryDirectory folder;
  GpuDevice device({.device = {}, .validation = true});
  const fg::vk::Membership pipelines{std::make_shared<fg::vk::SharedObjects>(device.device().context())};
  std::vector<Row> measured;
  for (const int framesPerSecond : {24, 6}) {
    render::RenderOptions options;
    options.scene = WALR_SCENES "/turntable.gltf";
    options.output = folder.path() / std::to_string(framesPerSecond);
    options.lastFrame = kFrames - 1;
    options.framesPerSecond = framesPerSecond;
    renderSequence(options, {});
    const Result given = denoised(device, pipelines, options.output, MotionDepth::Given);
    const Result still = denoised(device, pipelines, options.output, MotionDepth::StaticScene);
    const Result found = denoised(device, pipelines, options.output, MotionDepth::Found);
    // Finding depth is off by no more than a tenth of what it is for.
    EXPECT_NEAR(found.withoutHistory, given.withoutHistory, 0.1 * (still.withoutHistory - given.withoutHistory));
    measured.push_back({double(framesPerSecond), given.withoutHistory, still.withoutHistory, found.withoutHistory,
                        1e5 * difference(still, given), 1e5 * difference(found, given)});
  }
  device.refuseMessages();

  const GuideTable guide(WALR_GUIDE "/images.md", "Motion without depth");
  if (GuideTable::writing()) {
    std::string table = kHeading;
    for (const Row& row : measured) table += textOf(row);
    return guide.write(table);
  }
  const std::vector<Row> documented = rowsOf(guide.text());
  ASSERT_EQ(documented.size(), measured.size()) << "build the target update_guide";
  for (std::size_t row = 0; row < measured.size(); ++row) {
    for (std::size_t i = 0; i < measured[row].size(); ++i) {
      // Another compiler may round a path's vertices otherwise, which moves single pixels across an edge.
      EXPECT_NEAR(documented[row].at(i), measured[row].at(i), 0.02 * measured[row].at(i) + 0.5)
          << "build the target update_guide, which writes " << textOf(measured[row]);
    }
  }
}

}  // namespace
}  // namespace walr::test
