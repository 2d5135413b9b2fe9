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
#include "samples/image/pixel_rect.h"

namespace walr {

/// Refuse a path that exists and is no file: reading a pipe would wait for a writer, perhaps for good.
/// @throws InputError naming the path
void requireRegularFile(const std::filesystem::path& path);

/// Whether a file is an OpenEXR image with all of its pixels. False if it cannot be read.
bool isCompleteExr(const std::filesystem::path& path);

/// An OpenEXR file (scan lines or tiles) opened for reading. Opening reads the headers only, and no memory is allocated
/// before `checkExrHeaders` has accepted them.
///
/// Files of several parts and views are read as if they had one of each: `exrChannelName` says how channels are called.
/// Control characters in names are escaped (`printable`). Parts with deep pixels are left out.
class ExrReader {
 public:
  /// One channel to read and the image component that receives its values.
  struct Target {
    std::string channel;
    Image* image = nullptr;
    int component = 0;
  };

  /// @param view  of a file with several views, the one to read; without it, the names of channels contain their views
  /// @throws InputError when the file is missing, truncated or not OpenEXR, when it exceeds a limit, or when it lacks
  ///         the view
  explicit ExrReader(std::filesystem::path path, const std::string& view = {});
  ~ExrReader();
  ExrReader(ExrReader&&) noexcept;
  ExrReader& operator=(ExrReader&&) noexcept;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// The smallest rectangle that holds the data windows of all parts.
  [[nodiscard]] const PixelRect& dataWindow() const;
  [[nodiscard]] const PixelRect& displayWindow() const;
  /// Size of the data window in pixels.
  [[nodiscard]] int width() const { return dataWindow().size.x; }
  [[nodiscard]] int height() const { return dataWindow().size.y; }
  /// Names of all channels, sorted.
  [[nodiscard]] std::vector<std::string> channels() const;
  /// Names of all views, the default one first; empty if the file tells of no views.
  [[nodiscard]] const std::vector<std::string>& views() const;
  /// Whether the compression of channels changes the values of halves: B44, B44A, DWAA and DWAB do.
  [[nodiscard]] bool lossy() const;
  /// Header attribute of type M44f; nullopt if it is absent. The same for the two below.
  /// @throws InputError if it has another type
  [[nodiscard]] std::optional<glm::mat4> matrix(const std::string& name) const;
  /// Header attribute of type V2f.
  [[nodiscard]] std::optional<glm::vec2> vector(const std::string& name) const;
  /// Header attribute of type int.
  [[nodiscard]] std::optional<int> integer(const std::string& name) const;

  /// Check that the file holds all blocks of pixels that its headers claim. Call it before memory for the pixels
  /// is allocated: a damaged header may claim gigabytes.
  /// @throws InputError when the data are truncated or damaged
  void requireBlocks();

  /// Read channels of any type as floats, in one pass over each part that has some.
  /// @param place  where the images lie: pixels of theirs that the file lacks keep their values, and pixels of the file
  ///               that lie outside are left out
  /// @throws InputError when a channel is missing or subsampled, or when the data are truncated or damaged
  void read(std::span<const Target> targets, const PixelRect& place);
  /// The same for images that have the place and size of the data window.
  void read(std::span<const Target> targets) { read(targets, dataWindow()); }

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
/// @param place     of the images, of which the pixels in the data window are written; by default, the images are the
///                  whole picture
/// @throws OutputError
void writeExr(const std::filesystem::path& path, std::span<const ExrChannel> channels,
              std::span<const ExrAttribute> attributes = {}, const std::optional<ImagePlace>& place = std::nullopt);

/// Append one channel `name`.C for each letter C of `components`, such as "RGB" or "XYZ": the first letter names
/// component 0 of the image.
void appendChannels(std::vector<ExrChannel>& channels, const std::string& name, const std::string& components,
                    const Image& image, ExrType type = ExrType::Half);

}  // namespace walr
