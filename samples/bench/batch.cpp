#include "samples/bench/batch.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "samples/bench/bench_frame.h"
#include "samples/bench/npy.h"
#include "samples/denoise/gpu_denoiser.h"
#include "samples/errors.h"
#include "samples/image/fingerprint.h"
#include "samples/metrics/flip.h"
#include "samples/metrics/metrics.h"
#include "samples/metrics/ssim.h"
#include "samples/sequence/writer.h"

namespace walr {
namespace {

/// The state of one variant while it runs over the sequence.
struct Lane {
  GpuDenoiser denoiser;
  RunRecord record;
  std::optional<DisplayedPair> previous;
  std::vector<std::uint64_t> results;  ///< Fingerprints of the first pass's results, by frame.
  FrameTimes times;
};

/// For how many frames before this one each pixel's surface has been visible without a gap.
std::vector<float> surfaceAges(const std::vector<std::uint32_t>& previousPixels, const std::vector<float>& before) {
  std::vector<float> ages(previousPixels.size(), 0.0F);
  for (std::size_t i = 0; i < ages.size(); ++i) {
    if (previousPixels[i] != kNoPixel) ages[i] = before[previousPixels[i]] + 1.0F;
  }
  return ages;
}

std::uint64_t fingerprintOf(const Image& image) {
  return Fingerprint().add(std::as_bytes(image.values())).value();
}

/// Per-pixel root mean square error, mean SSIM and FLIP as one three-component image. Where they have no value, SSIM is
/// 1 and FLIP 0.
Image errorMaps(const DisplayedPair& pair, const PixelMask& mask, const std::vector<double>& flip) {
  const int width = pair.reference.width();
  const int height = pair.reference.height();
  Image maps(width, height, 3);
  std::vector<double> similarity(mask.size());
  std::vector<double> test(mask.size());
  std::vector<double> reference(mask.size());
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < mask.size(); ++i) {
      test[i] = pair.test.pixel(i)[c];
      reference[i] = pair.reference.pixel(i)[c];
      const double difference = test[i] - reference[i];
      maps.pixel(i)[0] += static_cast<float>(difference * difference / 3.0);
    }
    const std::vector<double> channel = similarityMap(test, reference, mask, width, height);
    for (std::size_t i = 0; i < mask.size(); ++i) similarity[i] += (std::isnan(channel[i]) ? 1.0 : channel[i]) / 3.0;
  }
  for (std::size_t i = 0; i < mask.size(); ++i) {
    maps.pixel(i)[0] = std::sqrt(maps.pixel(i)[0]);
    maps.pixel(i)[1] = static_cast<float>(similarity[i]);
    maps.pixel(i)[2] = static_cast<float>(flip[i]);
  }
  return maps;
}

class Batch {
 public:
  Batch(const GpuDevice& device, const Sequence& sequence, std::span<const Variant> variants,
        const BatchOptions& options)
      : sequence_(sequence), options_(options) {
    for (const Variant& variant : variants) {
      RunRecord record;
      record.variant = variant.name;
      lanes_.push_back({GpuDenoiser(device, *makeVariant(variant), sequence.extent(), sequence.denoiserLayout(), {}, 1,
                                    optionalImages(sequence.layout())),
                        std::move(record),
                        {},
                        {},
                        {}});
    }
  }

  std::vector<RunRecord> run() {
    const std::size_t frames = sequence_.entries().size();
    BenchFrame previous;
    std::vector<float> ages;
    for (std::size_t i = 0; i < frames; ++i) {
      BenchFrame frame = readBenchFrame(sequence_, i);
      const bool reset = frame.packed.frame.resetHistory;
      const std::vector<std::uint32_t> seenBefore = reset ? std::vector<std::uint32_t>(frame.judged.size(), kNoPixel)
                                                          : previousPixels(frame.surfaces, previous.surfaces);
      ages = surfaceAges(seenBefore, ages);
      keepGroundTruth(frame, ages);
      const std::vector<std::uint32_t> before =
          reset ? std::vector<std::uint32_t>() : judgedPairs(seenBefore, frame.judged, previous.judged);
      forEachLane(i, [&](Lane& lane) { measure(lane, frame, before, previous.judged); });
      previous = std::move(frame);
      options_.frameDone();
    }
    for (std::size_t repetition = 0; repetition < options_.repetitions; ++repetition) {
      for (std::size_t i = 0; i < frames; ++i) {
        const PackedFrame frame = packFrame(sequence_.read(i), judgedLight(sequence_));
        forEachLane(i + repetition, [&](Lane& lane) { time(lane, frame, i); });
        options_.frameDone();
      }
    }
    std::vector<RunRecord> records;
    for (Lane& lane : lanes_) {
      lane.record.timing = lane.times.timing(lanes_.front().times);
      records.push_back(std::move(lane.record));
    }
    return records;
  }

 private:
  template <typename Function>
  void forEachLane(std::size_t first, Function function) {
    for (std::size_t i = 0; i < lanes_.size(); ++i) function(lanes_[(first + i) % lanes_.size()]);
  }

  void measure(Lane& lane, const BenchFrame& input, const std::vector<std::uint32_t>& before,
               const PixelMask& previousMask) {
    const Frame& frame = input.packed.frame;
    const Image result = lane.denoiser.run(input.packed).lights.front();
    lane.results.push_back(fingerprintOf(result));
    FrameErrors& errors = lane.record.frames.emplace_back();
    errors.frame = frame.number;
    errors.resetHistory = frame.resetHistory;
    errors.nonFinite = countNonFinite(result);
    if (frame.reference) {
      DisplayedPair pair = display(result, input.reference(), input.judged);
      judge(lane, input, result, pair);
      if (!frame.resetHistory && lane.previous) {
        judgeChange(lane, pair, input.judged, before, previousMask);
      }
      lane.previous = std::move(pair);
    } else {
      lane.previous.reset();
    }
  }

  void judge(Lane& lane, const BenchFrame& input, const Image& result, const DisplayedPair& pair) {
    const PixelMask& mask = input.judged;
    FrameErrors& errors = lane.record.frames.back();
    const ErrorFigures figures = compare(pair, mask);
    const std::vector<double> flip = flipMap(pair, mask);
    errors.rmse = figures.rmse;
    errors.psnr = figures.psnr;
    errors.ssim = figures.ssim;
    errors.flip = maskedMean(flip, mask);
    errors.relativeMse = relativeMse(result, input.reference(), mask);
    if (input.specular()) judgeSpecular(errors, input, pair);
    if (isKept(errors.frame)) {
      writeNpy(picture(lane.record.variant, errors.frame), result);
      writeNpy(picture(lane.record.variant + ".errors", errors.frame), errorMaps(pair, mask, flip));
    }
  }

  static void judgeSpecular(FrameErrors& errors, const BenchFrame& input, const DisplayedPair& pair) {
    const Image& roughness = input.frame().roughness;
    errors.byRoughness = rmseByRoughness(pair, input.judged, roughness);
    const Image& half = input.referenceHalf();
    if (half.empty()) return;
    const auto squareOf = [&](const PixelMask& mask) { return cleanSquare(pair.test, input.reference(), half, mask); };
    errors.cleanSquare = squareOf(input.judged);
    errors.cleanSquareByRoughness = figuresByRoughness(input.judged, roughness, squareOf);
  }

  void judgeChange(Lane& lane, const DisplayedPair& pair, const PixelMask& mask,
                   const std::vector<std::uint32_t>& before, const PixelMask& previousMask) const {
    FrameErrors& errors = lane.record.frames.back();
    const std::vector<double> changes = errorChange(pair, *lane.previous, before);
    errors.flicker = flicker(changes);
    if (isKept(errors.frame)) {
      Image map(pair.test.width(), pair.test.height(), 1);
      for (std::size_t i = 0; i < changes.size(); ++i) map.pixel(i)[0] = static_cast<float>(changes[i]);
      writeNpy(picture(lane.record.variant + ".change", errors.frame), map);
    }
    if (const auto change = luminanceChange(pair, *lane.previous, mask, previousMask)) {
      errors.luminanceChange = change->test;
      errors.referenceLuminanceChange = change->reference;
    }
  }

  void time(Lane& lane, const PackedFrame& frame, std::size_t index) {
    const DenoisedPicture picture = lane.denoiser.run(frame);
    lane.record.reproducible = lane.record.reproducible && fingerprintOf(picture.lights.front()) == lane.results[index];
    lane.times.add(picture.passes);
  }

  void keepGroundTruth(const BenchFrame& input, const std::vector<float>& ages) const {
    const Frame& frame = input.packed.frame;
    if (!isKept(frame.number)) return;
    writeNpy(picture("_reference", frame.number), input.reference());
    writeNpy(picture("_noisy", frame.number), input.noisy());
    Image age(frame.depth.width(), frame.depth.height(), 1);
    std::ranges::copy(ages, age.values().begin());
    writeNpy(picture("_age", frame.number), age);
  }

  [[nodiscard]] bool isKept(int frame) const {
    return std::ranges::find(options_.pictureFrames, frame) != options_.pictureFrames.end();
  }
  [[nodiscard]] std::filesystem::path picture(const std::string& name, int frame) const {
    return options_.pictures / frameFileName(name, frame, "npy");
  }

  const Sequence& sequence_;
  const BatchOptions& options_;
  std::vector<Lane> lanes_;
};

}  // namespace

std::vector<RunRecord> runBatch(const GpuDevice& device, const Sequence& sequence, std::span<const Variant> variants,
                                const BatchOptions& options) {
  return Batch(device, sequence, variants, options).run();
}

}  // namespace walr
