#include "samples/image/exr.h"

#include <cstring>
#include <sstream>
#include <utility>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <glm/gtc/type_ptr.hpp>

#include "samples/errors.h"
#include "samples/image/file_output.h"
#include "samples/image/half.h"

namespace walr {
namespace {

// The largest image dimension of common Vulkan devices. Also keeps a damaged header from requesting terabytes.
constexpr int kLargestDimension = 16384;

/// A slice over a buffer of interleaved values whose first value belongs to the corner of the data window.
template <typename T>
Imf::Slice makeSlice(Imf::PixelType type, T* values, int component, int components, const Imath::Box2i& window) {
  const auto stride = static_cast<std::size_t>(components) * sizeof(T);
  const auto rowStride = stride * static_cast<std::size_t>(window.max.x - window.min.x + 1);
  return Imf::Slice::Make(type, values + component, window.min, window.max.x - window.min.x + 1,
                          window.max.y - window.min.y + 1, stride, rowStride);
}

}  // namespace

struct ExrReader::File {
  explicit File(const std::string& name) : input(name.c_str()) {}
  Imf::InputFile input;

  template <typename Attribute>
  [[nodiscard]] const Attribute* find(const std::string& name) const {
    return input.header().findTypedAttribute<Attribute>(name);
  }
};

ExrReader::ExrReader(std::filesystem::path path) : path_(std::move(path)) {
  try {
    file_ = std::make_unique<File>(path_.string());
  } catch (const std::exception& error) {
    throw InputError("cannot read " + path_.string() + " as OpenEXR: " + error.what());
  }
  if (width() > kLargestDimension || height() > kLargestDimension) {
    throw InputError(path_.string() + ": " + std::to_string(width()) + " x " + std::to_string(height()) +
                     " pixels exceed the limit of " + std::to_string(kLargestDimension) + " pixels a side");
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
    throw InputError("cannot read the pixels of " + path_.string() + ", it is truncated or damaged: " + error.what());
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
