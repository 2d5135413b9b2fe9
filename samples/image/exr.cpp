#include "samples/image/exr.h"

#include <cstdint>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTestFile.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <glm/gtc/type_ptr.hpp>

#include "samples/errors.h"
#include "samples/image/file_output.h"
#include "samples/image/half.h"

namespace walr {
namespace {

// The largest image dimension of common Vulkan devices.
constexpr int kLargestDimension = 16384;
// Twice as many as a picture of 8K has. Keeps a small file of high compression from requesting hundreds of gigabytes.
constexpr std::int64_t kMostPixels = std::int64_t{8192} * 8192;

/// A slice over a buffer of interleaved values whose first value belongs to the corner of the data window.
template <typename T>
Imf::Slice makeSlice(Imf::PixelType type, T* values, int component, int components, const Imath::Box2i& window) {
  const auto stride = static_cast<std::size_t>(components) * sizeof(T);
  const auto rowStride = stride * static_cast<std::size_t>(window.max.x - window.min.x + 1);
  return Imf::Slice::Make(type, values + component, window.min, window.max.x - window.min.x + 1,
                          window.max.y - window.min.y + 1, stride, rowStride);
}

InputError damaged(const std::filesystem::path& path, const std::exception& error) {
  return InputError("cannot read the pixels of " + path.string() + ", it is truncated or damaged: " + error.what());
}

/// Scan lines that a compression stores together.
int linesInBlock(Imf::Compression compression) {
  switch (compression) {
    case Imf::ZIP_COMPRESSION:
    case Imf::PXR24_COMPRESSION:
      return 16;
    case Imf::PIZ_COMPRESSION:
    case Imf::B44_COMPRESSION:
    case Imf::B44A_COMPRESSION:
    case Imf::DWAA_COMPRESSION:
      return 32;
    case Imf::DWAB_COMPRESSION:
      return 256;
    default:
      return 1;
  }
}

/// Bytes of a line without compression; 0 if it has subsampled channels, which not all lines have.
std::int64_t bytesOfLine(const Imf::Header& header) {
  const Imath::Box2i& window = header.dataWindow();
  std::int64_t bytes = 0;
  const Imf::ChannelList& list = header.channels();
  for (auto channel = list.begin(); channel != list.end(); ++channel) {
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1) return 0;
    const std::int64_t size = channel.channel().type == Imf::HALF ? 2 : 4;
    bytes += size * (std::int64_t{window.max.x} - window.min.x + 1);
  }
  return bytes;
}

/// Reads every block of scan lines without decompressing it.
void readBlocks(Imf::InputFile& file) {
  const Imf::Header& header = file.header();
  const Imath::Box2i& window = header.dataWindow();
  const std::int64_t line = header.compression() == Imf::NO_COMPRESSION ? bytesOfLine(header) : 0;
  for (int y = window.min.y; y <= window.max.y; y += linesInBlock(header.compression())) {
    const char* block = nullptr;
    int bytes = 0;
    file.rawPixelData(y, block, bytes);
    // OpenEXR takes what a line lacks for zeros.
    if (line != 0 && bytes != line) {
      throw std::runtime_error("a line has " + std::to_string(bytes) + " bytes, the header claims " +
                               std::to_string(line));
    }
  }
}

}  // namespace

void requireRegularFile(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw InputError("cannot read " + path.string() + ": it is not a regular file");
  }
}

bool isCompleteExr(const std::filesystem::path& path) {
  try {
    requireRegularFile(path);
    Imf::InputFile file(path.c_str());
    // A file may be cut off within its last block, which the table of blocks does not tell.
    const char* block = nullptr;
    int bytes = 0;
    file.rawPixelData(file.header().dataWindow().max.y, block, bytes);
    return file.isComplete();
  } catch (const std::exception&) {
    return false;
  }
}

struct ExrReader::File {
  explicit File(const std::string& name) : input(name.c_str()) {}
  Imf::InputFile input;

  template <typename Attribute>
  [[nodiscard]] const Attribute* find(const std::string& name) const {
    return input.header().findTypedAttribute<Attribute>(name);
  }
};

ExrReader::ExrReader(std::filesystem::path path) : path_(std::move(path)) {
  requireRegularFile(path_);
  int parts = 1;
  try {
    file_ = std::make_unique<File>(path_.string());
    if (Imf::isMultiPartOpenExrFile(path_.c_str())) parts = Imf::MultiPartInputFile(path_.c_str()).parts();
  } catch (const std::exception& error) {
    throw InputError("cannot read " + path_.string() + " as OpenEXR: " + error.what());
  }
  if (parts > 1) {
    throw InputError(path_.string() + " has " + std::to_string(parts) +
                     " parts; only files of one part are read. In Blender 5 turn on Interleave in the output's "
                     "settings, or render with export_frames.py.");
  }
  if (width() > kLargestDimension || height() > kLargestDimension) {
    throw InputError(path_.string() + ": " + std::to_string(width()) + " x " + std::to_string(height()) +
                     " pixels exceed the limit of " + std::to_string(kLargestDimension) + " pixels a side");
  }
  if (std::int64_t{width()} * height() > kMostPixels) {
    throw InputError(path_.string() + ": " + std::to_string(width()) + " x " + std::to_string(height()) +
                     " pixels exceed the limit of " + std::to_string(kMostPixels) + " pixels");
  }
}

ExrReader::~ExrReader() = default;
ExrReader::ExrReader(ExrReader&&) noexcept = default;
ExrReader& ExrReader::operator=(ExrReader&&) noexcept = default;

int ExrReader::width() const {
  const Imath::Box2i& window = file_->input.header().dataWindow();
  return window.max.x - window.min.x + 1;
}

int ExrReader::height() const {
  const Imath::Box2i& window = file_->input.header().dataWindow();
  return window.max.y - window.min.y + 1;
}

std::vector<std::string> ExrReader::channels() const {
  std::vector<std::string> names;
  const Imf::ChannelList& list = file_->input.header().channels();
  for (auto channel = list.begin(); channel != list.end(); ++channel) {
    names.emplace_back(channel.name());
  }
  return names;
}

std::optional<glm::mat4> ExrReader::matrix(const std::string& name) const {
  const auto* attribute = file_->find<Imf::M44fAttribute>(name);
  return attribute != nullptr ? std::optional(glm::make_mat4(attribute->value().getValue())) : std::nullopt;
}

std::optional<glm::vec2> ExrReader::vector(const std::string& name) const {
  const auto* attribute = file_->find<Imf::V2fAttribute>(name);
  return attribute != nullptr ? std::optional(glm::vec2(attribute->value().x, attribute->value().y)) : std::nullopt;
}

std::optional<int> ExrReader::integer(const std::string& name) const {
  const auto* attribute = file_->find<Imf::IntAttribute>(name);
  return attribute != nullptr ? std::optional(attribute->value()) : std::nullopt;
}

void ExrReader::requireBlocks() {
  try {
    // Blocks of tiles cannot be read without decompressing them.
    if (file_->input.header().hasTileDescription()) {
      if (!file_->input.isComplete()) throw std::runtime_error("tiles are missing");
    } else {
      readBlocks(file_->input);
    }
  } catch (const std::exception& error) {
    throw damaged(path_, error);
  }
}

void ExrReader::read(std::span<const Target> targets) {
  const Imf::Header& header = file_->input.header();
  const Imath::Box2i& window = header.dataWindow();
  Imf::FrameBuffer buffer;
  for (const Target& target : targets) {
    const Imf::Channel* channel = header.channels().findChannel(target.channel);
    if (channel == nullptr) {
      throw InputError(path_.string() + ": channel " + target.channel + " is missing");
    }
    if (channel->xSampling != 1 || channel->ySampling != 1) {
      throw InputError(path_.string() + ": channel " + target.channel + " is subsampled; every pixel needs a value");
    }
    buffer.insert(target.channel, makeSlice(Imf::FLOAT, target.image->values().data(), target.component,
                                            target.image->components(), window));
  }
  try {
    file_->input.setFrameBuffer(buffer);
    file_->input.readPixels(window.min.y, window.max.y);
  } catch (const std::exception& error) {
    throw damaged(path_, error);
  }
}

void writeExr(const std::filesystem::path& path, std::span<const ExrChannel> channels,
              std::span<const ExrAttribute> attributes) {
  const Image& first = *channels.front().image;
  Imf::Header header(first.width(), first.height());
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [name, value] : attributes) {
    if (const auto* matrix = std::get_if<glm::mat4>(&value)) {
      Imath::M44f stored;
      std::memcpy(stored.getValue(), glm::value_ptr(*matrix), sizeof(glm::mat4));
      header.insert(name, Imf::M44fAttribute(stored));
    } else if (const auto* vector = std::get_if<glm::vec2>(&value)) {
      header.insert(name, Imf::V2fAttribute({vector->x, vector->y}));
    } else if (const auto* integer = std::get_if<int>(&value)) {
      header.insert(name, Imf::IntAttribute(*integer));
    } else {
      header.insert(name, Imf::StringAttribute(std::get<std::string>(value)));
    }
  }

  const Imath::Box2i& window = header.dataWindow();
  std::vector<std::vector<float>> floats;
  std::vector<std::vector<Imath::half>> halves;
  Imf::FrameBuffer buffer;
  for (const ExrChannel& channel : channels) {
    const Image& image = *channel.image;
    const auto gather = [&](auto& planes, Imf::PixelType type, auto convert) {
      auto& plane = planes.emplace_back();
      plane.reserve(image.pixelCount());
      for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        plane.push_back(convert(image.pixel(i)[static_cast<std::size_t>(channel.component)]));
      }
      header.channels().insert(channel.name, Imf::Channel(type));
      buffer.insert(channel.name, makeSlice(type, plane.data(), 0, 1, window));
    };
    if (channel.type == ExrType::Half) {
      gather(halves, Imf::HALF, toHalf);
    } else {
      gather(floats, Imf::FLOAT, [](float value) { return value; });
    }
  }

  Imf::StdOSStream stream;
  try {
    Imf::OutputFile output(stream, header);
    output.setFrameBuffer(buffer);
    output.writePixels(first.height());
  } catch (const std::exception& error) {
    throw OutputError("cannot encode " + path.string() + ": " + error.what());
  }
  const std::string bytes = stream.str();
  writeFileAtomically(path, std::as_bytes(std::span(bytes)));
}

void appendChannels(std::vector<ExrChannel>& channels, const std::string& name, const std::string& components,
                    const Image& image, ExrType type) {
  for (std::size_t c = 0; c < components.size(); ++c) {
    const std::string prefix = name.empty() ? "" : name + ".";
    channels.push_back({prefix + components[c], &image, static_cast<int>(c), type});
  }
}

}  // namespace walr
