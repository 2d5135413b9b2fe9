#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "samples/denoise/frame_output.h"
#include "samples/denoise/packed_frame.h"
#include "samples/denoise/progress.h"
#include "samples/denoise/report.h"
#include "samples/image/exr.h"
#include "tests/samples/read_png.h"
#include "tests/samples/synthetic_sequence.h"
#include "tests/samples/temporary_directory.h"

namespace walr::denoise_test {
namespace {

using namespace std::chrono_literals;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(PackedFrame, HalfFloatTexelsRoundTripSaturateAndKeepNan) {
  Image image(3, 1, 3);
  image.at(0, 0, 1) = 0.1F;
  image.at(1, 0, 0) = 1e9F;
  image.at(2, 0, 2) = kNan;
  const Image back = unpackRgb(packRgba16(image), 3, 1);
  EXPECT_EQ(back.at(0, 0, 0), 0.0F);
  EXPECT_NEAR(back.at(0, 0, 1), 0.1F, 0.1F * 0x1p-11F);
  EXPECT_EQ(back.at(1, 0, 0), 65504.0F);
  EXPECT_TRUE(std::isnan(back.at(2, 0, 2)));
}

TEST(PackedFrame, ComponentsThatAnImageLacksAreZero) {
  Image image(1, 1, 2);
  image.at(0, 0, 0) = 1.0F;
  image.at(0, 0, 1) = -2.0F;
  EXPECT_EQ(packRgba16(image), (std::vector<Rgba16>{{0x3C00, 0xC000, 0, 0}}));
}

TEST(PackedFrame, ObjectNumbersAreNoneBelowZeroAndWhereTheyAreNoNumbers) {
  Frame frame;
  EXPECT_TRUE(packFrame(frame).objectId.empty());
  constexpr float kMost = 16777216.0F;  // Up to this number, floats represent all whole numbers.
  constexpr std::uint32_t kNone = 0xffffffff;
  frame.objectId = Image(5, 1, 1);
  std::ranges::copy(std::array{0.0F, kMost, -1.0F, kNan, std::numeric_limits<float>::infinity()},
                    frame.objectId.values().begin());
  EXPECT_EQ(packFrame(frame).objectId, (std::vector<std::uint32_t>{0, 1U << 24U, kNone, kNone, kNone}));
}

TEST(Composite, FollowsTheRenderingEquationOfTheLayout) {
  Image indirect(1, 1, 3);
  Image direct(1, 1, 3);
  Image albedo(1, 1, 3);
  Image emission(1, 1, 3);
  for (int c = 0; c < 3; ++c) {
    indirect.at(0, 0, c) = 2.0F;
    direct.at(0, 0, c) = 4.0F;
    albedo.at(0, 0, c) = 0.5F;
    emission.at(0, 0, c) = 0.25F;
  }
  albedo.at(0, 0, 1) = kNan;
  direct.at(0, 0, 2) = std::numeric_limits<float>::infinity();
  const Image lit = composite(indirect, direct, albedo, emission);
  EXPECT_EQ(lit.at(0, 0, 0), 3.25F);
  EXPECT_EQ(lit.at(0, 0, 1), 0.25F);
  EXPECT_EQ(lit.at(0, 0, 2), 1.25F);
}

class FrameOutputTest : public testing::Test {
 protected:
  FrameOutputTest() {
    denoised.frame = test::projectFrame(12, 16, 12);
    denoised.indirect = denoised.frame.indirect;
    options.directory = directory.path();
  }
  [[nodiscard]] std::vector<std::string> writtenFiles() const { return test::namesIn(directory.path()); }

  test::TemporaryDirectory directory;
  DenoisedFrame denoised;
  OutputOptions options;
};

TEST_F(FrameOutputTest, WritesIndirectLightByDefault) {
  FrameWriter(options).write(denoised);
  EXPECT_EQ(writtenFiles(), (std::vector<std::string>{"denoised_0012.exr"}));
  EXPECT_EQ(ExrReader(directory.path() / "denoised_0012.exr").channels(),
            (std::vector<std::string>{"Indirect.B", "Indirect.G", "Indirect.R"}));
}

TEST_F(FrameOutputTest, WritesACompositeAndPicturesWhenAsked) {
  options.composite = true;
  options.png = true;
  denoised.frame.reference = Reference{denoised.frame.indirect, {}};
  FrameWriter(options).write(denoised);
  EXPECT_EQ(writtenFiles(),
            (std::vector<std::string>{"comparison_0012.png", "denoised_0012.exr", "denoised_0012.png"}));
  ExrReader file(directory.path() / "denoised_0012.exr");
  EXPECT_EQ(file.channels(), (std::vector<std::string>{"B", "G", "Indirect.B", "Indirect.G", "Indirect.R", "R"}));
  Image sky(16, 12, 1);
  file.read(std::vector<ExrReader::Target>{{"R", &sky, 0}});
  EXPECT_EQ(sky.at(3, 0, 0), 2.0F);
}

TEST_F(FrameOutputTest, CompositesAddLightThatIsNotDiffuse) {
  options.composite = true;
  options.indirectPlane = "Layer.DiffInd";
  options.directPlane = "Layer.DiffDir";
  Frame& frame = denoised.frame;
  denoised.direct = Image(16, 12, 3);
  frame.nonDiffuse = Image(16, 12, 3);
  for (std::size_t i = 0; i < denoised.direct.values().size(); ++i) {
    denoised.indirect.values()[i] = 0.5F;
    denoised.direct.values()[i] = 4.0F;
    frame.nonDiffuse.values()[i] = static_cast<float>(i % 3);
  }
  FrameWriter(options).write(denoised);
  ExrReader file(directory.path() / "denoised_0012.exr");
  Image read(16, 12, 3);
  file.read(
      std::vector<ExrReader::Target>{{"B", &read, 0}, {"Layer.DiffDir.B", &read, 1}, {"Layer.DiffInd.B", &read, 2}});
  // On the wall the emission is 0. Twice the unit roundoff of half floats: of the albedo in the file and of the sum.
  EXPECT_NEAR(read.at(8, 9, 0), frame.albedo.at(8, 9, 2) * 4.5F + 2.0F, 6.0F * 0x1p-10F);
  EXPECT_EQ(read.at(8, 9, 1), 4.0F);
  EXPECT_EQ(read.at(8, 9, 2), 0.5F);
}

// Everything that is written lies over the frame in a compositor.
TEST_F(FrameOutputTest, ResultsHaveTheWindowsOfTheirFrame) {
  const ImagePlace place{{{4, 2}, {16, 12}}, {{5, 3}, {8, 7}}, {{0, 0}, {64, 48}}};
  denoised.frame.place = place;
  denoised.indirect.at(1, 1, 0) = 3.0F;  // The corner of the data window.
  denoised.views.push_back({"some", Image(16, 12, 3)});
  denoised.slopes.fill(Image(16, 12, 3));
  FrameWriter(options).write(denoised);
  for (const char* const name : {"denoised_0012.exr", "direction_0012.exr", "view_some_0012.exr"}) {
    const ExrReader file(directory.path() / name);
    EXPECT_EQ(file.dataWindow(), place.data) << name;
    EXPECT_EQ(file.displayWindow(), place.display) << name;
  }
  ExrReader file(directory.path() / "denoised_0012.exr");
  Image red(8, 7, 1);
  file.read(std::vector<ExrReader::Target>{{"Indirect.R", &red, 0}});
  EXPECT_EQ(red.at(0, 0, 0), 3.0F);
}

TEST_F(FrameOutputTest, DirectLightAloneIsWrittenAndMeasured) {
  options.png = true;
  denoised.direct = denoised.frame.direct;
  denoised.indirect = {};
  // The frame has a reference of the other light only.
  denoised.frame.reference = Reference{denoised.frame.indirect, {}};
  FrameWriter(options).write(denoised);
  EXPECT_EQ(ExrReader(directory.path() / "denoised_0012.exr").channels(),
            (std::vector<std::string>{"Direct.B", "Direct.G", "Direct.R"}));
  EXPECT_FALSE(measure(denoised).direct.denoised.rmse.has_value());
  denoised.frame.reference = Reference{{}, denoised.frame.direct};
  denoised.direct.at(8, 9, 0) += 1.0F;
  denoised.indirect = denoised.frame.indirect;
  const FrameReport report = measure(denoised);
  EXPECT_FALSE(report.indirect.denoised.rmse.has_value());
  EXPECT_GT(report.direct.denoised.rmse.value(), 0.0);
  EXPECT_EQ(report.direct.noisy.rmse, 0.0);
  // Both lights in one picture, of which one has a reference: the rows of the comparison are of one length.
  EXPECT_NO_THROW(FrameWriter(options).write(denoised));
}

TEST_F(FrameOutputTest, LightsPicturesByTheReferenceWhenAsked) {
  options.composite = true;
  Image direct = denoised.frame.direct;
  for (float& value : direct.values()) value += 1.0F;
  denoised.frame.reference = Reference{denoised.frame.indirect, direct, {}};
  const auto red = [&] {
    FrameWriter(options).write(denoised);
    ExrReader file(directory.path() / "denoised_0012.exr");
    Image lit(16, 12, 1);
    file.read(std::vector<ExrReader::Target>{{"R", &lit, 0}});
    return lit.at(8, 9, 0);
  };
  const float byFrame = red();
  options.referenceDirect = true;
  const float albedo = denoised.frame.albedo.at(8, 9, 0);
  ASSERT_GT(albedo, 0.0F);
  EXPECT_NEAR(red() - byFrame, albedo, 0x1p-9F);
}

TEST_F(FrameOutputTest, ExposesPicturesAlikeUntilACameraCut) {
  options.png = true;
  FrameWriter writer(options);
  // Displayed brightness of the result, for light that is a multiple of that of the first frame.
  const auto shown = [&](int number, float scale, bool cut) {
    denoised.frame.number = number;
    denoised.frame.resetHistory = cut;
    for (float& value : denoised.indirect.values()) value = scale * 0.01F;
    writer.write(denoised);
    const auto file = directory.path() / ("denoised_00" + std::to_string(number) + ".png");
    return int{test::readPng(file, 16, 12).at(0)};
  };
  // Middle grey, 0.18 / 1.18, is code value 109; four times as much light, 0.72 / 1.72, is 173.
  EXPECT_EQ(shown(20, 1.0F, true), 109);
  EXPECT_EQ(shown(21, 4.0F, false), 173);
  EXPECT_EQ(shown(22, 4.0F, true), 109);
}

TEST_F(FrameOutputTest, TellsTheNoiseOfAReferenceInHalves) {
  EXPECT_FALSE(measure(denoised).indirect.referenceNoise.has_value());
  Image half = denoised.frame.indirect;
  denoised.frame.reference = Reference{denoised.frame.indirect, {}, half};
  EXPECT_EQ(measure(denoised).indirect.referenceNoise, 0.0);
  for (float& value : denoised.frame.reference->indirectHalf.values()) value *= 1.5F;
  EXPECT_GT(measure(denoised).indirect.referenceNoise.value(), 0.0);
}

TEST_F(FrameOutputTest, MeasuresResultAndInput) {
  EXPECT_FALSE(measure(denoised).indirect.denoised.rmse.has_value());
  Image reference = denoised.frame.indirect;
  for (float& value : reference.values()) {
    value = 1.0F;
  }
  denoised.frame.reference = Reference{reference, {}};
  denoised.indirect = reference;
  denoised.gpuMilliseconds = 1.5;
  const FrameReport report = measure(denoised);
  EXPECT_EQ(report.indirect.denoised.rmse, 0.0);
  EXPECT_GT(report.indirect.noisy.rmse.value(), 0.1);
  EXPECT_FALSE(report.direct.denoised.rmse.has_value());
  EXPECT_EQ(report.frame, 12);
  EXPECT_EQ(report.gpuMilliseconds, 1.5);
  EXPECT_EQ(report.nonFiniteOutput, 0U);
}

// The tone map takes 0, 1 and 3 to 0, 1/2 and 3/4.
TEST_F(FrameOutputTest, TellsErrorsOfSpecularLightByRoughness) {
  const auto constant = [](int components, float value) {
    Image image(16, 12, components);
    std::ranges::fill(image.values(), value);
    return image;
  };
  Frame& frame = denoised.frame;
  frame.depth = constant(1, 2.0F);
  frame.normal = frame.specularAlbedo = frame.specular = denoised.specular = constant(3, 1.0F);
  frame.reference = Reference{.specular = constant(3, 1.0F)};
  frame.roughness = constant(1, 0.0F);
  const auto pixel = [&](int x, float roughness, float light) {
    frame.roughness.at(x, 0, 0) = roughness;
    for (int c = 0; c < 3; ++c) denoised.specular.at(x, 0, c) = light;
  };
  pixel(0, 0.1F, 3.0F);
  pixel(1, 0.59F, 1.0F);
  pixel(2, 1.0F, 0.0F);
  pixel(3, kNan, 0.0F);
  EXPECT_EQ(measure(denoised).byRoughness, (FiguresByRoughness{0.0, 0.25, std::nullopt, std::nullopt, 0.0, 0.5}));
}

DenoiseReport exampleReport() {
  DenoiseReport report{"walr", {{"iterations", "4"}}, "Some GPU", "some driver 1.2", false, "walr", "indirect", {16, 9},
                       {}};
  for (int i = 0; i < 6; ++i) {
    FrameReport frame;
    frame.frame = 10 + i;
    frame.gpuMilliseconds = i < 4 ? 10.0 : 2.0;
    frame.indirect.denoised = {i < 4 ? 0.5 : 0.25, 6.0, 0.75};
    frame.indirect.noisy = {0.5, std::nullopt, 0.5};
    report.frames.push_back(frame);
  }
  return report;
}

TEST(Report, JsonHasItsKeys) {
  const auto json = nlohmann::json::parse(reportJson(exampleReport()));
  EXPECT_EQ(json["method"], "walr");
  EXPECT_EQ(json["settings"]["iterations"], "4");
  EXPECT_EQ(json["device"], "Some GPU");
  EXPECT_EQ(json["driver"], "some driver 1.2");
  EXPECT_EQ(json["frames"].size(), 6U);
  EXPECT_EQ(json["frames"][1]["frame"], 11);
  EXPECT_EQ(json["frames"][1]["gpu_ms"], 10.0);
  EXPECT_EQ(json["frames"][1]["rmse"], 0.5);
  EXPECT_EQ(json["frames"][1]["psnr"], 6.0);
  EXPECT_EQ(json["frames"][1]["ssim"], 0.75);
  EXPECT_TRUE(json["frames"][1]["noisy"]["psnr"].is_null());
  EXPECT_DOUBLE_EQ(json["mean"]["gpu_ms"], 44.0 / 6.0);
  EXPECT_DOUBLE_EQ(json["mean"]["rmse"], 2.5 / 6.0);
  EXPECT_EQ(json["mean_after_4"]["gpu_ms"], 2.0);
  EXPECT_EQ(json["mean_after_4"]["rmse"], 0.25);
}

TEST(Report, EachLightHasItsErrors) {
  DenoiseReport report = exampleReport();
  EXPECT_TRUE(nlohmann::json::parse(reportJson(report))["mean"]["direct"]["rmse"].is_null());
  std::ostringstream one;
  printReport(one, report);
  EXPECT_EQ(one.str().find("direct light"), one.str().find("indirect light") + 2) << "of the indirect light only";
  for (FrameReport& frame : report.frames) frame.direct.denoised = {0.125, 7.0, frame.frame == 12 ? 0.0 : 0.5};
  const auto json = nlohmann::json::parse(reportJson(report));
  EXPECT_EQ(json["frames"][1]["direct"]["rmse"], 0.125);
  EXPECT_EQ(json["frames"][1]["rmse"], 0.5);
  EXPECT_EQ(json["mean"]["direct"]["psnr"], 7.0);
  EXPECT_DOUBLE_EQ(json["mean"]["direct"]["ssim"], 2.5 / 6.0);
  std::ostringstream both;
  printReport(both, report);
  EXPECT_NE(both.str().find("Errors of the direct light:"), std::string::npos);
  EXPECT_NE(both.str().find("0.12500"), std::string::npos) << both.str();
}

TEST(Report, ErrorsByRoughnessHaveTheMeanOfTheirFrames) {
  DenoiseReport report = exampleReport();
  report.frames[1].specular.denoised.rmse = 0.3;
  report.frames[1].byRoughness[1] = 0.25;
  report.frames[5].byRoughness[1] = 0.75;
  const auto json = nlohmann::json::parse(reportJson(report));
  EXPECT_EQ(json["frames"][1]["specular"]["rmse_by_roughness"][1], 0.25);
  EXPECT_EQ(json["mean"]["specular"]["rmse_by_roughness"][1], 0.5);
  EXPECT_EQ(json["mean_after_4"]["specular"]["rmse_by_roughness"][1], 0.75);
  EXPECT_TRUE(json["mean"]["specular"]["rmse_by_roughness"][0].is_null());
  std::ostringstream table;
  printReport(table, report);
  EXPECT_NE(table.str().find("0 to 0.1 -, 0.1 to 0.2 0.50000, 0.2 to 0.3 -"), std::string::npos) << table.str();
}

TEST(Report, CountersHaveAMeanAndAMaximum) {
  DenoiseReport report = exampleReport();
  EXPECT_FALSE(nlohmann::json::parse(reportJson(report))["frames"][0].contains("counters"));
  for (FrameReport& frame : report.frames) {
    frame.counters = {{"sky", 100}, {"no-history", frame.frame == 12 ? 60U : 0U}};
  }
  EXPECT_EQ(nlohmann::json::parse(reportJson(report))["frames"][2]["counters"]["no-history"], 60);
  std::ostringstream table;
  printReport(table, report);
  std::istringstream lines(table.str());
  std::string name;
  for (std::string line; name != "no-history" && std::getline(lines, line);) {
    std::istringstream words(line);
    double mean = 0.0;
    int most = 0;
    int frame = 0;
    if (!(words >> name) || name != "no-history") continue;
    ASSERT_TRUE(words >> mean >> most >> frame) << line;
    EXPECT_EQ(mean, 10.0);
    EXPECT_EQ(most, 60);
    EXPECT_EQ(frame, 12);
  }
  EXPECT_EQ(name, "no-history") << table.str();
}

TEST(Report, TableMarksASoftwareDevice) {
  DenoiseReport report = exampleReport();
  std::ostringstream hardware;
  printReport(hardware, report);
  EXPECT_NE(hardware.str().find("gpu ms"), std::string::npos);
  EXPECT_EQ(hardware.str().find("software"), std::string::npos);
  report.softwareDevice = true;
  std::ostringstream software;
  printReport(software, report);
  EXPECT_EQ(software.str().find("gpu ms"), std::string::npos);
  EXPECT_NE(software.str().find("Some GPU is a software device"), std::string::npos);
}

TEST(Progress, FormatsDurations) {
  EXPECT_EQ(formatDuration(0s), "0:00");
  EXPECT_EQ(formatDuration(125s), "2:05");
  EXPECT_EQ(formatDuration(3725s), "1:02:05");
}

TEST(Progress, WritesPlainLinesWhereThereIsNoTerminal) {
  std::ostringstream stream;
  {
    const auto start = Progress::Clock::now();
    Progress progress(stream, false, "frame", 3, start);
    progress.advance(start + 10s);
    progress.note("a note");
    progress.advance(start + 20s);
  }
  EXPECT_EQ(stream.str(), "frame 1 of 3, 0:20 left\na note\nframe 2 of 3, 0:10 left\n");
}

TEST(Progress, TellsTheRemainingTimeByWork) {
  std::ostringstream stream;
  const auto start = Progress::Clock::now();
  Progress progress(stream, false, "file", 3, start, 250.0);
  progress.worked(10.0, start + 10s);
  progress.advance(start + 10s);
  progress.skipped(40.0);
  progress.advance(start + 20s);
  progress.worked(90.0, start + 50s);
  // The last file completes the bar, whatever the estimate of the work was.
  progress.advance(start + 60s);
  EXPECT_EQ(stream.str(),
            "file 1 of 3, 4:00 left\nfile 2 of 3, 6:40 left\nfile 2 of 3, 0:55 left\nfile 3 of 3, 0:00 left\n");
}

TEST(Progress, DrawsABarOnATerminal) {
  std::ostringstream stream;
  {
    const auto start = Progress::Clock::now();
    Progress progress(stream, true, "frame", 2, start);
    progress.advance(start + 61s);
  }
  EXPECT_NE(stream.str().find("\r[###############...............] frame 1 of 2, 1:01 left"), std::string::npos);
  EXPECT_EQ(stream.str().back(), '\n');
}

}  // namespace
}  // namespace walr::denoise_test
