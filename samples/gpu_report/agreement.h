#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "samples/bench/variant.h"
#include "samples/denoise/gpu_device.h"
#include "samples/denoise/packed_frame.h"
#include "samples/image/image.h"
#include "samples/sequence/layout.h"

namespace walr {

/// A short sequence, of whose last frame the results are compared.
struct ComparedSequence {
  std::string name;
  fg::Extent extent;
  const Layout* layout = nullptr;
  std::vector<PackedFrame> frames;  ///< The first one resets the histories.
  Image truth;                      ///< Of the last frame; empty if it is not known.
};

/// How a method's result on the device compares with that of a reference device.
struct Agreement {
  std::string variant;
  std::string sequence;
  std::string hash;           ///< Of the result's values; equal results have equal hashes.
  std::size_t nonFinite = 0;  ///< Values of the result that are not finite.
  /// RMSE against the truth after the tone map, of the device and of the reference device.
  std::optional<double> rmse;
  std::optional<double> referenceRmse;
  /// Of the two results, after the tone map: root mean square and largest difference, and the share of pixels that
  /// differ by more than a step of 8 bits.
  std::optional<double> rmsDifference;
  std::optional<double> largestDifference;
  std::optional<double> differingShare;
  std::string whyNot;  ///< Why the method did not run, or there is nothing to compare with; empty without a reason.

  /// Whether the results differ by more than a tenth of the method's own error. Errors add up by their squares, so
  /// that smaller differences change the error by less than half a per cent.
  [[nodiscard]] bool suspicious() const;
};

/// A source of results to compare with.
class ReferenceResults {
 public:
  /// Results that another device computes. @param device must outlive this
  explicit ReferenceResults(const GpuDevice& device) : device_(&device) {}
  /// Results that another report has stored (`resultFile`).
  explicit ReferenceResults(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The last frame of a method.
  /// @throws InputError naming a stored result that is missing or has another size; fg::vk::Error
  [[nodiscard]] Image result(const Variant& variant, const ComparedSequence& sequence) const;

 private:
  const GpuDevice* device_ = nullptr;
  std::filesystem::path folder_;
};

/// The file in a report's folder that stores a method's result on a sequence.
std::filesystem::path resultFile(const std::filesystem::path& folder, const std::string& sequence,
                                 const std::string& variant);

/// Run a method on a sequence, store its last frame in the folder, and compare it.
/// @param reference null: compare with the truth only
/// @throws OutputError, fg::vk::DeviceLost
Agreement compareMethod(const GpuDevice& device, const Variant& variant, const ComparedSequence& sequence,
                        const ReferenceResults* reference, const std::filesystem::path& folder);

}  // namespace walr
