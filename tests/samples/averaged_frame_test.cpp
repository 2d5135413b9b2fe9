#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "samples/denoise/averaged_frame.h"
#include "samples/image/exr.h"
#include "tests/samples/synthetic_sequence.h"
#include "tests/samples/temporary_directory.h"

namespace walr::averaged_frame_test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Image plain(int width, int height, int components, float value) {
  Image image(width, height, components);
  for (float& component : image.values()) component = value;
  return image;
}

// Two squares of 2 x 2 pixels with diffuse surfaces. All lights are numbered from 1 on, in reading order.
DenoisedFrame twoSquares() {
  DenoisedFrame denoised;
  Frame& frame = denoised.frame;
  frame.number = 7;
  frame.albedo = plain(4, 2, 3, 0.5F);
  frame.normal = plain(4, 2, 3, 0.5F);
  frame.depth = plain(4, 2, 1, 3.0F);
  frame.indirect = Image(4, 2, 3);
  for (std::size_t i = 0; i < frame.indirect.pixelCount(); ++i) {
    for (float& component : frame.indirect.pixel(i)) component = static_cast<float>(i + 1);
  }
  frame.direct = denoised.indirect = frame.indirect;
  frame.reference = {frame.indirect, {}, frame.indirect};
  return denoised;
}

void makeSky(Frame& frame, int x, int y) {
  frame.depth.at(x, y, 0) = kBackgroundDepth;
  for (int c = 0; c < 3; ++c) frame.albedo.at(x, y, c) = frame.normal.at(x, y, c) = 0.0F;
}

TEST(AveragedLights, AreMeansOverDiffuseSurfaces) {
  DenoisedFrame denoised = twoSquares();
  makeSky(denoised.frame, 1, 0);
  denoised.indirect.at(1, 0, 2) = 1e6F;
  const DenoisedFrame small = averagedLights(denoised, 2);
  ASSERT_EQ(small.indirect.width(), 2);
  ASSERT_EQ(small.indirect.height(), 1);
  EXPECT_FLOAT_EQ(small.indirect.at(0, 0, 2), (1.0F + 5.0F + 6.0F) / 3.0F);
  EXPECT_FLOAT_EQ(small.indirect.at(1, 0, 0), (3.0F + 4.0F + 7.0F + 8.0F) / 4.0F);
  EXPECT_FLOAT_EQ(small.frame.direct.at(0, 0, 1), 4.0F);
  EXPECT_FLOAT_EQ(small.frame.reference->indirect.at(0, 0, 1), 4.0F);
  EXPECT_FLOAT_EQ(small.frame.reference->indirectHalf.at(1, 0, 1), 5.5F);
  EXPECT_TRUE(small.frame.reference->direct.empty());
  EXPECT_TRUE(small.direct.empty());
  EXPECT_EQ(small.frame.number, 7);
}

TEST(AveragedLights, KeepWhatASquareWithoutDiffuseSurfacesShows) {
  DenoisedFrame denoised = twoSquares();
  for (const int x : {0, 1}) {
    for (const int y : {0, 1}) makeSky(denoised.frame, x, y);
  }
  const DenoisedFrame small = averagedLights(denoised, 2);
  EXPECT_FLOAT_EQ(small.indirect.at(0, 0, 0), (1.0F + 2.0F + 5.0F + 6.0F) / 4.0F);
  EXPECT_EQ(small.frame.depth.at(0, 0, 0), kBackgroundDepth);
  EXPECT_EQ(small.frame.albedo.at(0, 0, 0), 0.0F);
}

TEST(AveragedLights, CountASquareIfOneOfItsPixelsCounts) {
  DenoisedFrame denoised = twoSquares();
  makeSky(denoised.frame, 0, 0);
  makeSky(denoised.frame, 1, 0);
  denoised.frame.depth.at(0, 1, 0) = 9.0F;
  const DenoisedFrame small = averagedLights(denoised, 2);
  EXPECT_EQ(small.frame.depth.at(0, 0, 0), 9.0F);
  EXPECT_EQ(small.frame.albedo.at(0, 0, 0), 0.5F);
  EXPECT_EQ(small.frame.normal.at(0, 0, 2), 0.5F);
  EXPECT_EQ(measure(denoised, averagedLights(denoised, 2)).indirect.denoised.rmse, 0.0);
}

TEST(AveragedLights, TakeSparseLightFromItsSamplesOnly) {
  DenoisedFrame denoised = twoSquares();
  denoised.frame.light = {.columns = 2, .rows = 2};
  denoised.frame.lightOffset = {1, 0};
  const DenoisedFrame small = averagedLights(denoised, 2);
  EXPECT_EQ(small.frame.indirect.at(0, 0, 0), 2.0F);
  EXPECT_EQ(small.frame.indirect.at(1, 0, 0), 4.0F);
  EXPECT_EQ(small.frame.direct.at(1, 0, 0), 5.5F);
  EXPECT_EQ(small.indirect.at(1, 0, 0), 5.5F);
}

TEST(AveragedLights, LeaveSquaresWithoutAReferenceOutOfErrors) {
  DenoisedFrame denoised = twoSquares();
  for (float& value : denoised.frame.reference->indirect.pixel(0)) value = kNan;
  for (float& value : denoised.indirect.pixel(1)) value += 1.0F;
  EXPECT_TRUE(std::isnan(averagedLights(denoised, 2).frame.reference->indirect.at(0, 0, 0)));
  // The error lies in the square without a reference.
  EXPECT_EQ(measure(denoised, averagedLights(denoised, 2)).indirect.denoised.rmse, 0.0);
  EXPECT_GT(measure(denoised).indirect.denoised.rmse, 0.0);
}

TEST(AveragedLights, OppositeErrorsInASquareAreNone) {
  DenoisedFrame denoised = twoSquares();
  denoised.gpuMilliseconds = 2.5;
  denoised.counters = {{"clipped", 3}};
  for (int c = 0; c < 3; ++c) {
    denoised.indirect.at(0, 0, c) += 0.5F;
    denoised.indirect.at(1, 1, c) -= 0.5F;
  }
  const FrameReport report = measure(denoised, averagedLights(denoised, 2));
  EXPECT_EQ(report.indirect.denoised.rmse, 0.0);
  EXPECT_EQ(report.gpuMilliseconds, 2.5);
  EXPECT_EQ(report.counters.size(), 1U);
  EXPECT_EQ(report.frame, 7);
  for (float& value : denoised.indirect.pixel(3)) value = kNan;
  EXPECT_EQ(measure(denoised, averagedLights(denoised, 2)).nonFiniteOutput, 3U)
      << "values of the frame are counted, not means";
}

TEST(AveragedExtent, SquaresFillTheFrame) {
  EXPECT_EQ(averagedExtent({12, 8}, 4), (fg::Extent{3, 2}));
  EXPECT_THROW(static_cast<void>(averagedExtent({12, 10}, 4)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(averagedExtent({10, 12}, 4)), std::invalid_argument);
}

// A mean of products is not the product of means.
TEST(AveragedPictures, AreLitBeforeTheyAreAveraged) {
  const test::TemporaryDirectory directory;
  DenoisedFrame denoised = twoSquares();
  denoised.frame.emission = plain(4, 2, 3, 0.25F);
  denoised.frame.direct = plain(4, 2, 3, 0.0F);
  for (int c = 0; c < 3; ++c) denoised.frame.albedo.at(0, 0, c) = 1.0F;
  FrameWriter({.directory = directory.path(), .composite = true}).write(denoised, averagedLights(denoised, 2));
  ExrReader file(directory.path() / "denoised_0007.exr");
  ASSERT_EQ(file.width(), 2);
  ASSERT_EQ(file.height(), 1);
  Image read(2, 1, 2);
  file.read(std::vector<ExrReader::Target>{{"R", &read, 0}, {"Indirect.R", &read, 1}});
  EXPECT_EQ(read.at(0, 0, 0), (1.0F * 1.0F + 0.5F * (2.0F + 5.0F + 6.0F)) / 4.0F + 0.25F);
  EXPECT_EQ(read.at(0, 0, 1), 3.5F);
}

}  // namespace
}  // namespace walr::averaged_frame_test
