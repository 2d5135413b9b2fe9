#include "samples/image/exr_limits.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "samples/errors.h"
#include "samples/image/exr_names.h"

namespace walr {
namespace {

/// What is wrong with a file; `checkExrHeaders` adds its name.
using Fault = std::runtime_error;

constexpr std::uint32_t kMagic = 20000630;
constexpr std::uint32_t kVersion = 2;
// Flags of the version, from the specification ("OpenEXR File Layout").
constexpr std::uint32_t kTiled = 0x200;
constexpr std::uint32_t kDeep = 0x800;
constexpr std::uint32_t kMultiPart = 0x1000;
constexpr std::uint32_t kKnownFlags = 0x1e00;

/// Sizes in bytes of the values of types that have one size.
const std::map<std::string_view, std::size_t>& sizesOfTypes() {
  static const std::map<std::string_view, std::size_t> sizes{
      {"box2i", 16},      {"box2f", 16},   {"chromaticities", 32},
      {"compression", 1}, {"double", 8},   {"envmap", 1},
      {"float", 4},       {"int", 4},      {"keycode", 28},
      {"lineOrder", 1},   {"m33f", 36},    {"m33d", 72},
      {"m44f", 64},       {"m44d", 128},   {"rational", 8},
      {"tiledesc", 9},    {"timecode", 8}, {"v2i", 8},
      {"v2f", 8},         {"v2d", 16},     {"v3i", 12},
      {"v3f", 12},        {"v3d", 24},     {"deepImageState", 1}};
  return sizes;
}

/// The value of an attribute, read from its start.
class Value {
 public:
  explicit Value(std::span<const char> bytes) : rest_(bytes) {}

  template <typename Number>
  Number number() {
    Number value{};
    std::memcpy(&value, take(sizeof value).data(), sizeof value);  // Files and all supported machines: little-endian.
    return value;
  }
  std::string_view text(std::size_t length) {
    const std::span<const char> bytes = take(length);
    return {bytes.data(), bytes.size()};
  }
  /// Text up to a zero byte.
  std::string_view terminated() {
    const auto end = std::ranges::find(rest_, '\0');
    if (end == rest_.end()) throw Fault("a name in its header has no end");
    const std::string_view found = text(static_cast<std::size_t>(end - rest_.begin()));
    take(1);
    return found;
  }
  [[nodiscard]] std::size_t left() const { return rest_.size(); }

 private:
  std::span<const char> take(std::size_t length) {
    if (length > rest_.size()) throw Fault("an attribute of its header is too short");
    const std::span<const char> taken = rest_.first(length);
    rest_ = rest_.subspan(length);
    return taken;
  }
  std::span<const char> rest_;
};

void requireArea(std::int64_t width, std::int64_t height) {
  requireWithin(kMostPixelsASide, std::max(width, height));
  requireWithin(kMostPixels, width * height);
}

struct Window {
  std::int64_t width = 0;
  std::int64_t height = 0;
};

/// What decides how much memory a part takes.
struct Part {
  std::map<std::string, std::string, std::less<>> types;  ///< Of attributes, by name.
  std::optional<Window> data;
  std::optional<Window> display;
  std::optional<Window> tile;
  std::optional<std::uint8_t> compression;
  std::string type;
  std::int64_t channels = 0;
  std::int64_t bytesOfPixel = 0;
};

Window readWindow(Value value) {
  std::array<std::int64_t, 4> corners{};
  for (std::int64_t& corner : corners) corner = value.number<std::int32_t>();
  const Window window{corners[2] - corners[0] + 1, corners[3] - corners[1] + 1};
  if (window.width < 1 || window.height < 1) throw Fault("a window in its header has no pixels");
  requireArea(window.width, window.height);
  for (const std::int64_t corner : corners) requireWithin(kFarthestCorner, std::max(corner, -corner));
  return window;
}

Window readTile(Value value) {
  const Window tile{value.number<std::uint32_t>(), value.number<std::uint32_t>()};
  if (tile.width < 1 || tile.height < 1) throw Fault("its tiles have no pixels");
  requireWithin(kMostPixelsASide, std::max(tile.width, tile.height));
  return tile;
}

void readChannels(Value value, Part& part) {
  std::string last;
  for (std::string name = std::string(value.terminated()); !name.empty(); name = std::string(value.terminated())) {
    // The library takes the pixels for sorted, as the format demands, whatever the order of the list.
    if (name <= last) {
      throw Fault("its channels are not in alphabetical order (" + printable(last) + ", " + printable(name) +
                  "), so that their pixels cannot be told apart");
    }
    last = name;
    const auto type = value.number<std::int32_t>();
    constexpr std::int32_t kHalf = 1;
    if (type < 0 || type > 2) throw Fault("a channel has the unknown type " + std::to_string(type));
    value.number<std::int32_t>();  // A flag and three bytes without meaning.
    for (int axis = 0; axis < 2; ++axis) {
      if (value.number<std::int32_t>() < 1) throw Fault("a channel has a sampling below 1");
    }
    part.bytesOfPixel += type == kHalf ? 2 : 4;
    ++part.channels;
  }
  if (value.left() > 0) throw Fault("its list of channels ends early");
}

/// Checks the size of an attribute's value, which the library takes from the type and partly from the value itself.
void checkSize(const std::string& name, const std::string& type, Value value) {
  const std::size_t size = value.left();
  std::size_t right = size;
  if (const auto fixed = sizesOfTypes().find(type); fixed != sizesOfTypes().end()) {
    right = fixed->second;
  } else if (type == "floatvector") {
    right = size / sizeof(float) * sizeof(float);
  } else if (type == "preview") {
    const std::size_t columns = value.number<std::uint32_t>();
    const std::size_t rows = value.number<std::uint32_t>();
    requireWithin(kMostPixelsASide, static_cast<std::int64_t>(std::max(columns, rows)));
    right = 8 + 4 * columns * rows;
  } else if (type == "stringvector") {
    while (value.left() > 0) value.text(value.number<std::uint32_t>());
  } else if (type == "idmanifest") {
    value.number<std::uint32_t>();
  }
  if (size != right) {
    throw Fault("the attribute " + printable(name) + " of type " + printable(type) + " has " + std::to_string(size) +
                " bytes instead of " + std::to_string(right));
  }
}

std::int64_t ratioRoundedUp(std::int64_t a, std::int64_t b) {
  return (a + b - 1) / b;
}

/// Headers, read one after the other.
class Headers {
 public:
  explicit Headers(const std::filesystem::path& path) : stream_(path, std::ios::binary), size_(file_size(path)) {
    if (!stream_) throw Fault("it cannot be opened");
  }

  void check() {
    if (number() != kMagic) throw Fault("it is no OpenEXR file");
    const std::uint32_t version = number();
    if ((version & 0xffU) != kVersion || (version & ~(0xffU | kKnownFlags)) != 0) {
      throw Fault("its version of the format is unknown");
    }
    const bool multiPart = (version & kMultiPart) != 0;
    if (!multiPart && (version & kDeep) != 0) throw Fault("it has deep pixels, which are not read");
    std::int64_t parts = 0;
    std::int64_t channels = 0;
    std::int64_t tables = 0;
    while (std::optional<Part> part = next()) {
      requireWithin(kMostParts, ++parts);
      requireWithin(kMostChannels, channels += part->channels);
      tables += static_cast<std::int64_t>(sizeof(std::uint64_t)) *
                blocksOf(*part,
                         multiPart ? part->type.starts_with("tiled") || part->type.starts_with("deept")
                                   : (version & kTiled) != 0,
                         multiPart);
      if (!multiPart) break;
    }
    if (parts == 0) throw Fault("it has no parts");
    if (tables > size_ - at_) {
      throw Fault("it is truncated: its tables of blocks take " + std::to_string(tables) + " bytes, and " +
                  std::to_string(size_ - at_) + " follow the headers");
    }
  }

 private:
  /// The next header; none where an empty one ends those of several parts.
  std::optional<Part> next() {
    Part part;
    for (std::string name = text(); !name.empty(); name = text()) {
      const std::string type = text();
      const std::uint32_t size = number();
      requireWithin(kLargestAttribute, size);
      if (size > size_ - at_) throw Fault("it ends within the attribute " + printable(name));
      std::vector<char> bytes(size);
      read(bytes);
      checkSize(name, type, Value(bytes));
      if (!part.types.emplace(name, type).second) throw Fault("the attribute " + printable(name) + " exists twice");
      note(name, type, Value(bytes), part);
    }
    return part.types.empty() ? std::nullopt : std::optional(std::move(part));
  }

  /// Keep what an attribute says about memory. An attribute of the name with another type is refused.
  static void note(const std::string& name, const std::string& type, Value value, Part& part) {
    const auto is = [&](std::string_view wantedName, std::string_view wantedType) {
      if (name != wantedName) return false;
      if (type != wantedType) throw Fault("the attribute " + name + " has the type " + printable(type));
      return true;
    };
    if (is("dataWindow", "box2i")) part.data = readWindow(value);
    if (is("displayWindow", "box2i")) part.display = readWindow(value);
    if (is("tiles", "tiledesc")) part.tile = readTile(value);
    if (is("compression", "compression")) part.compression = value.number<std::uint8_t>();
    if (is("channels", "chlist")) readChannels(value, part);
    if (is("type", "string")) part.type = value.text(value.left());
  }

  /// Blocks of a part, at least: further levels of tiles not counted, of which there are at most about thrice as many.
  static std::int64_t blocksOf(const Part& part, bool tiled, bool multiPart) {
    if (!part.data || !part.display || !part.compression || !part.types.contains("channels")) {
      throw Fault("a header has no dataWindow, displayWindow, compression or channels");
    }
    constexpr std::array<std::string_view, 4> kTypes{"scanlineimage", "tiledimage", "deepscanline", "deeptile"};
    if ((multiPart || !part.type.empty()) && std::ranges::find(kTypes, part.type) == kTypes.end()) {
      throw Fault("a part has the unknown type '" + printable(part.type) + "'");
    }
    const std::int64_t lines = exrLinesInBlock(*part.compression);
    if (!tiled) {
      requireWithin(kLargestBlock, part.bytesOfPixel * part.data->width * lines);
      return ratioRoundedUp(part.data->height, lines);
    }
    if (!part.tile) throw Fault("the size of its tiles is missing");
    requireWithin(kLargestBlock, part.bytesOfPixel * part.tile->width * part.tile->height);
    return ratioRoundedUp(part.data->width, part.tile->width) * ratioRoundedUp(part.data->height, part.tile->height);
  }

  void read(std::span<char> bytes) {
    at_ += static_cast<std::int64_t>(bytes.size());
    requireWithin(kLargestHeaders, at_);
    if (!stream_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) throw Fault("it ends within a header");
  }
  std::uint32_t number() {
    std::array<char, sizeof(std::uint32_t)> bytes{};
    read(bytes);
    return Value(bytes).number<std::uint32_t>();
  }
  /// Text up to a zero byte.
  std::string text() {
    constexpr std::size_t kLongest = 255;
    std::string found;
    std::array<char, 1> byte{};
    for (read(byte); byte.front() != '\0'; read(byte)) {
      if (found.size() == kLongest) throw Fault("a name in its header is longer than 255 bytes");
      found += byte.front();
    }
    return found;
  }

  std::ifstream stream_;
  std::int64_t size_;
  std::int64_t at_ = 0;
};

}  // namespace

void requireWithin(const FileLimit& limit, std::int64_t number) {
  if (number > limit.most) {
    throw Fault("there are " + std::to_string(number) + " " + std::string(limit.of) + "; the limit is " +
                std::to_string(limit.most));
  }
}

void requireWithinLimits(const PixelRect& window) {
  requireArea(window.size.x, window.size.y);
}

std::int64_t exrLinesInBlock(std::uint8_t compression) {
  // In the order of the specification: none, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA, DWAB, and since OpenEXR 3.4
  // HTJ2K256 and HTJ2K32, which older libraries refuse.
  constexpr std::array kLines{1, 1, 1, 16, 32, 16, 32, 32, 32, 256, 256, 32};
  if (compression >= kLines.size()) throw Fault("it has the unknown compression " + std::to_string(compression));
  return kLines.at(compression);
}

void checkExrHeaders(const std::filesystem::path& path) {
  try {
    Headers(path).check();
  } catch (const std::runtime_error& fault) {
    throw InputError("cannot read " + path.string() + " as OpenEXR: " + fault.what());
  }
}

}  // namespace walr
