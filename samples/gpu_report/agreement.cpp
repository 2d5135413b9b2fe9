#include "samples/gpu_report/agreement.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "framegraph/vulkan/error.h"
#include "samples/denoise/gpu_denoiser.h"
#include "samples/errors.h"
#include "samples/image/exr.h"
#include "samples/image/file_output.h"
#include "samples/image/fingerprint.h"
#include "samples/metrics/metrics.h"

namespace walr {
namespace {

constexpr double kStepOf8Bits = 1.0 / 255.0;
constexpr double kShareOfOwnError = 0.1;
constexpr std::string_view kResults = "results";

Image lastFrame(const GpuDevice& device, const Variant& variant, const ComparedSequence& sequence) {
  GpuDenoiser denoiser(device, *makeVariant(variant), sequence.extent, *sequence.layout);
  Image result;
  for (const PackedFrame& frame : sequence.frames) result = denoiser.run(frame).lights.front();
  return result;
}

Image storedResult(const std::filesystem::path& file, fg::Extent extent) {
  ExrReader reader(file);
  if (reader.width() != static_cast<int>(extent.width) || reader.height() != static_cast<int>(extent.height)) {
    throw InputError(file.string() +
                     " is of another size than the results of this report: compare reports that were "
                     "made with the same options");
  }
  Image image(reader.width(), reader.height(), 3);
  const ExrReader::Target targets[] = {{"R", &image, 0}, {"G", &image, 1}, {"B", &image, 2}};
  reader.read(targets);
  return image;
}

PixelMask everyPixel(const Image& image) {
  PixelMask mask(image.pixelCount(), 1);
  return mask;
}

void compareWith(const Image& reference, const Image& result, Agreement& agreement) {
  const PixelMask mask = everyPixel(result);
  const DisplayedPair pair = display(result, reference, mask);
  agreement.rmsDifference = compare(pair, mask).rmse;
  double largest = 0.0;
  std::size_t differing = 0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    double ofPixel = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      ofPixel = std::max(ofPixel, static_cast<double>(std::abs(pair.test.pixel(i)[c] - pair.reference.pixel(i)[c])));
    }
    largest = std::max(largest, ofPixel);
    differing += ofPixel > kStepOf8Bits ? 1 : 0;
  }
  agreement.largestDifference = largest;
  agreement.differingShare = static_cast<double>(differing) / static_cast<double>(mask.size());
}

std::optional<double> errorOf(const Image& result, const Image& truth) {
  return truth.empty() ? std::nullopt : compare(result, truth, everyPixel(truth)).rmse;
}

}  // namespace

bool Agreement::suspicious() const {
  return nonFinite > 0 || (rmsDifference && referenceRmse && *rmsDifference > kShareOfOwnError * *referenceRmse);
}

std::filesystem::path resultFile(const std::filesystem::path& folder, const std::string& sequence,
                                 const std::string& variant) {
  return folder / kResults / (sequence + "_" + variant + ".exr");
}

Image ReferenceResults::result(const Variant& variant, const ComparedSequence& sequence) const {
  if (device_ != nullptr) return lastFrame(*device_, variant, sequence);
  return storedResult(resultFile(folder_, sequence.name, variant.name), sequence.extent);
}

Agreement compareMethod(const GpuDevice& device, const Variant& variant, const ComparedSequence& sequence,
                        const ReferenceResults* reference, const std::filesystem::path& folder) {
  Agreement agreement;
  agreement.variant = variant.name;
  agreement.sequence = sequence.name;
  try {
    const Image result = lastFrame(device, variant, sequence);
    agreement.hash = Fingerprint().add(std::as_bytes(result.values())).text();
    agreement.nonFinite = countNonFinite(result);
    agreement.rmse = errorOf(result, sequence.truth);
    std::vector<ExrChannel> channels;
    channels.reserve(3);
    for (int c = 0; c < 3; ++c) channels.push_back({std::string(1, "RGB"[c]), &result, c, ExrType::Half});
    prepareOutputDirectory(folder / kResults);
    writeExr(resultFile(folder, sequence.name, variant.name), channels);
    if (reference == nullptr) return agreement;
    const Image other = reference->result(variant, sequence);
    agreement.referenceRmse = errorOf(other, sequence.truth);
    compareWith(other, result, agreement);
  } catch (const fg::vk::DeviceLost&) {
    throw;
  } catch (const std::invalid_argument& error) {
    agreement.whyNot = error.what();
  } catch (const fg::vk::Error& error) {
    agreement.whyNot = error.what();
  } catch (const InputError& error) {
    agreement.whyNot = error.what();
  }
  return agreement;
}

}  // namespace walr
