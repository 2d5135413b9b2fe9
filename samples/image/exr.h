#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include "samples/image/image.h"

namespace walr {

/// Refuse a path that exists and is no file: reading a pipe would wait for a writer, perhaps for good.
/// @throws InputError naming the path
void requireRegularFile(const std::filesystem::path& path);

/// Whether a file is an OpenEXR image with all of its pixels. False if it cannot be read.
bool isCompleteExr(const std::filesystem::path& path);

/// An OpenEXR file (scan lines or tiles, first part) opened for reading. Opening reads the header only.
class ExrReader {
 public:
  /// One channel to read and the image component that receives its values.
  struct Target {
    std::string channel;
    Image* image = nullptr;  ///< Has the file's size.
    int component = 0;
  };

  /// @throws InputError when the file is missing, truncated or not OpenEXR, or when its size is out of range
  explicit ExrReader(std::filesystem::path path);
  ~ExrReader();
  ExrReader(ExrReader&&) noexcept;
  ExrReader& operator=(ExrReader&&) noexcept;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Size of the data window in pixels.
  [[nodiscard]] int width() const;
  [[nodiscard]] int height() const;
  /// Names of all channels, sorted.
  [[nodiscard]] std::vector<std::string> channels() const;
  /// Header attribute of type M44f; nullopt if it is absent or of another type. The same for the two below.
  [[nodiscard]] std::optional<glm::mat4> matrix(const std::string& name) const;
  /// Header attribute of type V2f.
  [[nodiscard]] std::optional<glm::vec2> vector(const std::string& name) const;
  /// Header attribute of type int.
  [[nodiscard]] std::optional<int> integer(const std::string& name) const;

  /// Check that the file holds all blocks of pixels that its header claims. Call it before memory for the pixels
  /// is allocated: a damaged header may claim gigabytes.
  /// @throws InputError when the data are truncated or damaged
  void requireBlocks();

  /// Read channels of any type as floats, in one pass over the file.
  /// @throws InputError when a channel is missing or subsampled, or when the data are truncated or damaged
  void read(std::span<const Target> targets);

 private:
  struct File;
  std::filesystem::path path_;
  std::unique_ptr<File> file_;
};

/// How a channel is stored.
enum class ExrType { Half, Float };

/// One channel to write: a component of an image.
struct ExrChannel {
  std::string name;
  const Image* image = nullptr;
  int component = 0;
  ExrType type = ExrType::Half;
};

/// A header attribute to write. A matrix is written as its 16 floats in GLM's order: GLM's column-major matrix for
/// column vectors and Imath's row-major matrix for row vectors have the same memory layout.
using ExrAttribute = std::pair<std::string, std::variant<glm::mat4, glm::vec2, int, std::string>>;

/// Write a scan-line file with ZIP compression. The write is atomic: see `writeFileAtomically`.
/// @param channels  their images must have one size
/// @throws OutputError
void writeExr(const std::filesystem::path& path, std::span<const ExrChannel> channels,
              std::span<const ExrAttribute> attributes = {});

/// Append one channel `name`.C for each letter C of `components`, such as "RGB" or "XYZ": the first letter names
/// component 0 of the image.
void appendChannels(std::vector<ExrChannel>& channels, const std::string& name, const std::string& components,
                    const Image& image, ExrType type = ExrType::Half);

}  // namespace walr
