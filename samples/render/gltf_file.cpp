#include "samples/render/gltf_file.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <deque>
#include <fstream>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "samples/render/gltf_json.h"
#include "samples/render/scene_error.h"
#include "samples/render/scene_limits.h"

namespace walr::render::gltf {
namespace {

namespace fs = std::filesystem;

/// The files of a scene that are read one after the other.
struct FilesRead {
  std::uintmax_t budget = kMostSceneBytes.most;  ///< Bytes left of the limit for all files together.
  Fingerprint* contents = nullptr;               ///< Takes in the bytes; may be null.
  std::deque<std::size_t> lengths{};             ///< Of the buffers, which are read before the images.
};

std::vector<unsigned char> readWholeFile(const fs::path& file, const FilesRead& files) {
  std::error_code error;
  if (!fs::exists(file, error)) {
    throw SceneError("no such file");
  }
  if (!fs::is_regular_file(file, error)) {
    throw SceneError("not a regular file");
  }
  const std::uintmax_t size = fs::file_size(file, error);
  if (error || size > kLargestSceneFile.most) {
    throw SceneError(error ? error.message() : "larger than " + std::to_string(kLargestSceneFile.most) + " bytes");
  }
  if (size > files.budget) {
    throw SceneError("the scene's files exceed " + std::to_string(kMostSceneBytes.most) +
                     " bytes in all; a file counts once for each time it is named");
  }
  std::vector<unsigned char> bytes(size);
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()))) {
    throw SceneError("cannot be read");
  }
  if (files.contents != nullptr) files.contents->add(std::as_bytes(std::span(bytes)));
  return bytes;
}

bool isBinary(const std::vector<unsigned char>& bytes) {
  return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

// The header of a GLB file and of its first chunk, which holds the JSON text (specification, 4.4).
constexpr std::size_t kHeader = 20;
constexpr std::size_t kVersionAt = 4;
constexpr std::size_t kFileLengthAt = 8;
constexpr std::size_t kChunkLengthAt = 12;
constexpr std::size_t kChunkHeader = 8;

std::uint32_t word(const std::vector<unsigned char>& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, &bytes[at], sizeof value);
  return value;
}

// The JSON text: all of a .gltf file, or the first chunk of a .glb file.
std::string_view jsonText(const std::vector<unsigned char>& bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!isBinary(bytes)) {
    return text;
  }
  if (bytes.size() < kHeader) {
    throw SceneError("truncated: a GLB file has at least 20 bytes, this one has " + std::to_string(bytes.size()));
  }
  if (const std::uint32_t version = word(bytes, kVersionAt); version != 2) {
    throw SceneError("its GLB container has version " + std::to_string(version) + "; only version 2 is supported");
  }
  const std::uint32_t chunk = word(bytes, kChunkLengthAt);
  if (chunk > bytes.size() - kHeader) {
    throw SceneError("truncated: its JSON chunk should have " + std::to_string(chunk) + " bytes, the file has " +
                     std::to_string(bytes.size() - kHeader));
  }
  return text.substr(kHeader, chunk);
}

// The chunk of a .glb file after the JSON text, which holds the first buffer; empty if there is none.
std::span<const unsigned char> binaryChunk(const std::vector<unsigned char>& bytes) {
  const std::size_t at = kHeader + word(bytes, kChunkLengthAt);
  if (bytes.size() < at + kChunkHeader || std::memcmp(&bytes[at + 4], "BIN", 4) != 0) return {};
  const std::size_t length = word(bytes, at);
  const std::span<const unsigned char> rest = std::span(bytes).subspan(at + kChunkHeader);
  if (length > rest.size()) {
    throw SceneError("truncated: its binary chunk should have " + std::to_string(length) + " bytes, the file has " +
                     std::to_string(rest.size()));
  }
  return rest.first(length);
}

// A .glb file with another JSON text. The parser demands chunks of whole words and the right length of the file, which
// writers miss.
std::vector<unsigned char> packed(std::string json, std::span<const unsigned char> binary) {
  const auto padded = [](std::size_t size) { return (size + 3) / 4 * 4; };
  json.resize(padded(json.size()), ' ');
  std::vector<unsigned char> result;
  const auto add = [&](std::size_t value) {
    const auto narrow = static_cast<std::uint32_t>(value);
    const auto* const first = reinterpret_cast<const unsigned char*>(&narrow);
    result.insert(result.end(), first, first + sizeof narrow);
  };
  const std::string_view magic = "glTF";
  result.assign(magic.begin(), magic.end());
  add(2);
  add(kHeader + json.size() + (binary.empty() ? 0 : kChunkHeader + padded(binary.size())));
  add(json.size());
  const std::string_view jsonType = "JSON";
  result.insert(result.end(), jsonType.begin(), jsonType.end());
  result.insert(result.end(), json.begin(), json.end());
  if (binary.empty()) return result;
  add(padded(binary.size()));
  const std::string_view binaryType("BIN\0", 4);
  result.insert(result.end(), binaryType.begin(), binaryType.end());
  result.insert(result.end(), binary.begin(), binary.end());
  result.resize(result.size() + padded(binary.size()) - binary.size());
  return result;
}

// tinygltf calls this for every image. An image with a URI is stored without decoding. An image in a buffer view is not
// read here, because tinygltf has not checked that the view lies within its buffer.
bool keepEncodedImage(tinygltf::Image* image, int /*index*/, std::string* /*errors*/, std::string* /*warnings*/,
                      int /*width*/, int /*height*/, const unsigned char* bytes, int size, void* /*user*/) {
  if (image->bufferView < 0 && size > 0) {
    image->image.assign(bytes, bytes + size);
  }
  return true;
}

bool fileExists(const std::string& file, void* /*user*/) {
  std::error_code error;
  return fs::is_regular_file(file, error);
}

/// @param user  a FilesRead
bool readFile(std::vector<unsigned char>* bytes, std::string* errors, const std::string& file, void* user) {
  auto& files = *static_cast<FilesRead*>(user);
  try {
    *bytes = readWholeFile(file, files);
    files.budget -= bytes->size();
    if (files.lengths.empty()) return true;
    bytes->resize(std::min(bytes->size(), files.lengths.front()));  // The parser demands this very length.
    files.lengths.pop_front();
    return true;
  } catch (const SceneError& error) {
    *errors += file + ": " + error.what() + "\n";
    return false;
  }
}

std::string samePath(const std::string& path, void* /*user*/) {
  return path;
}

bool refuseToWrite(std::string* /*errors*/, const std::string& /*file*/, const std::vector<unsigned char>& /*bytes*/,
                   void* /*user*/) {
  return false;
}

// Newer versions of tinygltf have one more callback, and return false, without effect, if one is missing.
template <typename Parser, typename Callbacks>
void setCallbacks(Parser& parser, Callbacks callbacks) {
  if constexpr (requires { callbacks.GetFileSizeInBytes; }) {
    callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string&, void*) {
      *size = 0;  // `readFile` looks at it.
      return true;
    };
    if (!parser.SetFsCallbacks(callbacks)) throw std::logic_error("tinygltf has callbacks that are not known here");
  } else {
    parser.SetFsCallbacks(callbacks);
  }
}

// Of one line, and short: the parser quotes data URIs.
std::string shortened(std::string text) {
  constexpr std::size_t kLongest = 300;
  text.erase(text.find_last_not_of('\n') + 1);
  std::ranges::replace(text, '\n', ' ');
  return text.size() > kLongest ? text.substr(0, kLongest) + "..." : text;
}

}  // namespace

tinygltf::Model readModel(const std::filesystem::path& file, Fingerprint* contents) {
  FilesRead files{.contents = contents};
  std::vector<unsigned char> bytes = readWholeFile(file, files);
  const std::string_view text = jsonText(bytes);
  const std::span<const unsigned char> binary = isBinary(bytes) ? binaryChunk(bytes) : std::span<const unsigned char>();
  std::optional<std::string> json = prepareJson(text, !binary.empty(), files.lengths);
  if (isBinary(bytes)) {
    const bool whole = text.size() % 4 == 0 && binary.size() % 4 == 0 && word(bytes, kFileLengthAt) == bytes.size() &&
                       bytes.size() == kHeader + text.size() + (binary.empty() ? 0 : kChunkHeader + binary.size());
    if (json || !whole) bytes = packed(json ? std::move(*json) : std::string(text), binary);
  } else if (json) {
    bytes.assign(json->begin(), json->end());
  }

  tinygltf::TinyGLTF parser;
  parser.SetImageLoader(&keepEncodedImage, nullptr);
  tinygltf::FsCallbacks callbacks{};
  callbacks.FileExists = &fileExists;
  callbacks.ExpandFilePath = &samePath;
  callbacks.ReadWholeFile = &readFile;
  callbacks.WriteWholeFile = &refuseToWrite;
  callbacks.user_data = &files;
  setCallbacks(parser, callbacks);

  tinygltf::Model model;
  std::string errors;
  std::string warnings;
  const std::string folder = file.has_parent_path() ? file.parent_path().string() : ".";
  const auto size = static_cast<unsigned int>(bytes.size());
  bool parsed = false;
  try {
    parsed = isBinary(bytes) ? parser.LoadBinaryFromMemory(&model, &errors, &warnings, bytes.data(), size, folder)
                             : parser.LoadASCIIFromString(&model, &errors, &warnings,
                                                          reinterpret_cast<const char*>(bytes.data()), size, folder);
  } catch (const std::exception& error) {
    errors = error.what();
  }
  if (!parsed || !errors.empty()) {  // Of some errors the parser makes default values.
    throw SceneError("not a valid glTF 2.0 file: " +
                     (errors.empty() ? "it cannot be parsed" : shortened(std::move(errors))));
  }
  restoreAbsentViews(model);
  return model;
}

}  // namespace walr::render::gltf
