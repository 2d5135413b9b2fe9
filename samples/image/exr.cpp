#include "samples/image/exr.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfStringVectorAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <glm/gtc/type_ptr.hpp>

#include "passes/settings/text.h"
#include "samples/errors.h"
#include "samples/image/exr_limits.h"
#include "samples/image/exr_names.h"
#include "samples/image/file_output.h"
#include "samples/image/half.h"

namespace walr {
namespace {

PixelRect rectOf(const Imath::Box2i& window) {
  const glm::ivec2 corner(window.min.x, window.min.y);
  return {corner, glm::ivec2(window.max.x, window.max.y) - corner + 1};
}

Imath::Box2i boxOf(const PixelRect& rect) {
  return {{rect.corner.x, rect.corner.y}, {rect.end().x - 1, rect.end().y - 1}};
}

/// A slice over a buffer of interleaved values whose first value belongs to the corner of the data window.
template <typename T>
Imf::Slice makeSlice(Imf::PixelType type, T* values, int component, int components, const PixelRect& window) {
  const auto stride = static_cast<std::size_t>(components) * sizeof(T);
  const auto rowStride = stride * static_cast<std::size_t>(window.size.x);
  return Imf::Slice::Make(type, values + component, {window.corner.x, window.corner.y}, window.size.x, window.size.y,
                          stride, rowStride);
}

InputError damaged(const std::filesystem::path& path, const std::exception& error) {
  return InputError("cannot read the pixels of " + path.string() +
                    ", it is truncated or damaged: " + printable(error.what()));
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
void readBlocks(Imf::InputPart& part) {
  const Imf::Header& header = part.header();
  const Imath::Box2i& window = header.dataWindow();
  const std::int64_t line = header.compression() == Imf::NO_COMPRESSION ? bytesOfLine(header) : 0;
  const auto lines = static_cast<int>(exrLinesInBlock(static_cast<std::uint8_t>(header.compression())));
  for (int y = window.min.y; y <= window.max.y; y += lines) {
    const char* block = nullptr;
    int bytes = 0;
    part.rawPixelData(y, block, bytes);
    // OpenEXR takes what a line lacks for zeros.
    if (line != 0 && bytes != line) {
      throw std::runtime_error("a line has " + std::to_string(bytes) + " bytes, the header claims " +
                               std::to_string(line));
    }
  }
}

bool isFlat(const Imf::Header& header) {
  return !header.hasType() || header.type() == Imf::SCANLINEIMAGE || header.type() == Imf::TILEDIMAGE;
}

/// Copies those pixels of an image that another image has, too.
void copyCommon(const Image& from, int component, const PixelRect& fromPlace, Image& to, int toComponent,
                const PixelRect& toPlace) {
  const glm::ivec2 first = glm::max(fromPlace.corner, toPlace.corner);
  const glm::ivec2 end = glm::min(fromPlace.end(), toPlace.end());
  for (int y = first.y; y < end.y; ++y) {
    for (int x = first.x; x < end.x; ++x) {
      to.at(x - toPlace.corner.x, y - toPlace.corner.y, toComponent) =
          from.at(x - fromPlace.corner.x, y - fromPlace.corner.y, component);
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
    checkExrHeaders(path);
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
  /// Where a channel is stored.
  struct Stored {
    int part = 0;
    std::string name;
  };

  File(const std::string& file, const std::string& view) : input(file.c_str()), path(file) {
    findViews();
    if (!view.empty() && std::ranges::find(views, view) == views.end()) {
      throw std::runtime_error("it has no view '" + view + "'; it has " + (views.empty() ? "none" : join(views)));
    }
    for (int part = 0; part < input.parts(); ++part) {
      if (isFlat(input.header(part))) addChannels(part, view.empty() && views.size() == 1 ? views.front() : view);
    }
    display = rectOf(input.header(0).displayWindow());
    requireWithinLimits(data);  // Of all parts.
  }

  template <typename Attribute>
  [[nodiscard]] const Attribute* find(const std::string& name) const {
    for (int part = 0; part < input.parts(); ++part) {
      if (const auto* found = input.header(part).findTypedAttribute<Attribute>(name)) return found;
    }
    return nullptr;
  }

  /// @throws InputError if there is an attribute of this name but of another type
  template <typename Attribute>
  [[nodiscard]] const Attribute* require(const std::string& name) const {
    const auto* const found = find<Attribute>(name);
    for (int part = 0; found == nullptr && part < input.parts(); ++part) {
      const auto other = input.header(part).find(name);
      if (other == input.header(part).end()) continue;
      throw InputError(path + ": its header attribute " + name + " has the type " +
                       printable(other.attribute().typeName()) + " in place of " + Attribute::staticTypeName());
    }
    return found;
  }

  Imf::MultiPartInputFile input;
  std::string path;
  std::vector<std::string> views;
  std::map<std::string, Stored> channels;  ///< Of the chosen view, by their names outside of this class.
  std::set<int> parts;                     ///< That have these channels.
  PixelRect data;
  PixelRect display;

 private:
  [[nodiscard]] std::string viewOf(int part) const {
    const Imf::Header& header = input.header(part);
    return header.hasView() ? printable(header.view()) : "";
  }

  void findViews() {
    if (const auto* listed = find<Imf::StringVectorAttribute>("multiView")) {
      requireWithin(kMostViews, static_cast<std::int64_t>(listed->value().size()));
      for (const std::string& view : listed->value()) views.push_back(printable(view));
    }
    for (int part = 0; part < input.parts(); ++part) {
      const std::string view = viewOf(part);
      if (!view.empty() && std::ranges::find(views, view) == views.end()) views.push_back(view);
    }
  }

  void addChannels(int part, const std::string& wantedView) {
    const Imf::Header& header = input.header(part);
    const std::string partName = input.parts() > 1 ? printable(header.name()) : "";
    const std::string view = viewOf(part);
    const Imf::ChannelList& list = header.channels();
    for (auto channel = list.begin(); channel != list.end(); ++channel) {
      const std::string stored = printable(channel.name());
      const ExrChannelName found = exrChannelName({.channel = stored, .part = partName, .view = view, .views = views});
      if (!wantedView.empty() && !found.view.empty() && found.view != wantedView) continue;
      std::string name = !wantedView.empty() ? found.name : partName.empty() ? stored : withView(found);
      // Parts may be view layers with the same passes.
      if (channels.contains(name)) name = partName + "." + name;
      channels.emplace(name, Stored{part, channel.name()});
      data = parts.empty() ? rectOf(header.dataWindow()) : united(data, rectOf(header.dataWindow()));
      parts.insert(part);
    }
  }
};

ExrReader::ExrReader(std::filesystem::path path, const std::string& view) : path_(std::move(path)) {
  requireRegularFile(path_);
  checkExrHeaders(path_);
  try {
    file_ = std::make_unique<File>(path_.string(), view);
  } catch (const std::exception& error) {
    throw InputError("cannot read " + path_.string() + " as OpenEXR: " + printable(error.what()));
  }
  if (file_->parts.empty()) throw InputError(path_.string() + " has no channels with flat pixels");
}

ExrReader::~ExrReader() = default;
ExrReader::ExrReader(ExrReader&&) noexcept = default;
ExrReader& ExrReader::operator=(ExrReader&&) noexcept = default;

const PixelRect& ExrReader::dataWindow() const {
  return file_->data;
}

const PixelRect& ExrReader::displayWindow() const {
  return file_->display;
}

const std::vector<std::string>& ExrReader::views() const {
  return file_->views;
}

std::vector<std::string> ExrReader::channels() const {
  std::vector<std::string> names;
  for (const auto& [name, stored] : file_->channels) names.push_back(name);
  return names;
}

bool ExrReader::lossy() const {
  constexpr std::array kLossy{Imf::B44_COMPRESSION, Imf::B44A_COMPRESSION, Imf::DWAA_COMPRESSION,
                              Imf::DWAB_COMPRESSION};
  return std::ranges::any_of(file_->parts, [&](int part) {
    return std::ranges::find(kLossy, file_->input.header(part).compression()) != kLossy.end();
  });
}

std::optional<glm::mat4> ExrReader::matrix(const std::string& name) const {
  const auto* attribute = file_->require<Imf::M44fAttribute>(name);
  return attribute != nullptr ? std::optional(glm::make_mat4(attribute->value().getValue())) : std::nullopt;
}

std::optional<glm::vec2> ExrReader::vector(const std::string& name) const {
  const auto* attribute = file_->require<Imf::V2fAttribute>(name);
  return attribute != nullptr ? std::optional(glm::vec2(attribute->value().x, attribute->value().y)) : std::nullopt;
}

std::optional<int> ExrReader::integer(const std::string& name) const {
  const auto* attribute = file_->require<Imf::IntAttribute>(name);
  return attribute != nullptr ? std::optional(attribute->value()) : std::nullopt;
}

void ExrReader::requireBlocks() {
  try {
    for (const int number : file_->parts) {
      Imf::InputPart part(file_->input, number);
      // Blocks of tiles cannot be read without decompressing them.
      if (part.header().hasTileDescription()) {
        if (!part.isComplete()) throw std::runtime_error("tiles are missing");
      } else {
        readBlocks(part);
      }
    }
  } catch (const std::exception& error) {
    throw damaged(path_, error);
  }
}

void ExrReader::read(std::span<const Target> targets, const PixelRect& place) {
  std::map<int, std::vector<Target>> byPart;  // With the names that channels have in their parts.
  for (const Target& target : targets) {
    const auto found = file_->channels.find(target.channel);
    if (found == file_->channels.end()) {
      throw InputError(path_.string() + ": channel " + target.channel + " is missing");
    }
    const auto& [number, name] = found->second;
    const Imf::Channel& channel = *file_->input.header(number).channels().findChannel(name);
    if (channel.xSampling != 1 || channel.ySampling != 1) {
      throw InputError(path_.string() + ": channel " + target.channel + " is subsampled; every pixel needs a value");
    }
    byPart[number].push_back({name, target.image, target.component});
  }
  try {
    for (const auto& [number, wanted] : byPart) {
      Imf::InputPart part(file_->input, number);
      const PixelRect window = rectOf(part.header().dataWindow());
      // OpenEXR reads whole lines, so that another place needs a copy.
      const bool inPlace = window == place;
      Image copy;
      if (!inPlace) copy = Image(window.size.x, window.size.y, static_cast<int>(wanted.size()));
      Imf::FrameBuffer buffer;
      for (std::size_t i = 0; i < wanted.size(); ++i) {
        Image& image = inPlace ? *wanted[i].image : copy;
        const int component = inPlace ? wanted[i].component : static_cast<int>(i);
        if (buffer.findSlice(wanted[i].channel) != nullptr) continue;  // Below, it is a copy of the first one.
        buffer.insert(wanted[i].channel,
                      makeSlice(Imf::FLOAT, image.values().data(), component, image.components(), window));
      }
      part.setFrameBuffer(buffer);
      part.readPixels(window.corner.y, window.end().y - 1);
      for (std::size_t i = 0; i < wanted.size(); ++i) {
        const Target& target = wanted[i];
        const auto first = std::ranges::find(wanted, target.channel, &Target::channel);
        if (!inPlace) {
          copyCommon(copy, static_cast<int>(first - wanted.begin()), window, *target.image, target.component, place);
        } else if (&*first != &target) {
          copyCommon(*first->image, first->component, window, *target.image, target.component, place);
        }
      }
    }
  } catch (const std::exception& error) {
    throw damaged(path_, error);
  }
}

void writeExr(const std::filesystem::path& path, std::span<const ExrChannel> channels,
              std::span<const ExrAttribute> attributes, const std::optional<ImagePlace>& place) {
  const Image& first = *channels.front().image;
  const PixelRect whole{{0, 0}, {first.width(), first.height()}};
  const ImagePlace at = place.value_or(ImagePlace{whole, whole, whole});
  const PixelRect& window = at.data;
  Imf::Header header(boxOf(at.display), boxOf(window));
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

  std::vector<std::vector<float>> floats;
  std::vector<std::vector<Imath::half>> halves;
  Imf::FrameBuffer buffer;
  for (const ExrChannel& channel : channels) {
    const Image& image = *channel.image;
    const auto gather = [&](auto& planes, Imf::PixelType type, auto convert) {
      auto& plane = planes.emplace_back();
      plane.reserve(static_cast<std::size_t>(window.size.x) * static_cast<std::size_t>(window.size.y));
      const glm::ivec2 corner = window.corner - at.image.corner;
      for (int y = corner.y; y < corner.y + window.size.y; ++y) {
        for (int x = corner.x; x < corner.x + window.size.x; ++x) {
          plane.push_back(convert(image.at(x, y, channel.component)));
        }
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
    output.writePixels(window.size.y);
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
