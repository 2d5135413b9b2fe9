#include "tests/samples/synthetic_sequence.h"

#include <array>
#include <fstream>
#include <iterator>
#include <random>

#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>

#include "samples/image/exr.h"
#include "samples/sequence/writer.h"

namespace walr::test {
namespace {

constexpr float kWallDepth = 4.0F;
constexpr float kLight = 0.5F;
constexpr float kAlbedo = 0.8F;

// A symmetric OpenGL perspective projection: vertical field of view 90 degrees, near plane 0.1, far plane 100.
constexpr std::array<float, 16> kProjection = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1.002002F, -1, 0, 0, -0.2002002F, 0};
constexpr std::array<float, 16> kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// Whether row `y` shows the sky.
bool isSky(int y, int height) {
  return y == 0 && height > 1;
}

/// One plane with `wall` on the wall and `sky` above it.
Image plane(int width, int height, float wall, float sky) {
  Image image(width, height, 1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at(x, y, 0) = isSky(y, height) ? sky : wall;
    }
  }
  return image;
}

/// Noisy light on the wall with the mean `kLight`: one pixel in four is lit, as with 1 sample per pixel.
Image noisyLight(int width, int height, std::uint32_t seed) {
  std::mt19937 random(seed);
  Image image = plane(width, height, kLight, 0.0F);
  for (float& value : image.values()) {
    value = random() % 4 == 0 ? 4.0F * value : 0.0F;
  }
  return image;
}

void addRgb(Channels& channels, const std::string& name, const Image& value) {
  for (const char* component : {".R", ".G", ".B"}) {
    channels[name + component] = value;
  }
}

void writeEdited(const std::filesystem::path& file, Channels channels, const Edit& edit) {
  if (edit) {
    edit(channels);
  }
  writeChannels(file, channels);
}

void copyPlane(const Image& from, Image& to, int component) {
  for (std::size_t i = 0; i < from.pixelCount(); ++i) {
    to.pixel(i)[static_cast<std::size_t>(component)] = from.pixel(i)[0];
  }
}

}  // namespace

std::filesystem::path SyntheticSequence::frameFile(int number) const {
  return folder_ / frameFileName("noisy", number, "exr");
}

void SyntheticSequence::writeFrame(int number, const Edit& edit) const {
  Channels channels;
  addRgb(channels, "DiffInd", noisyLight(width_, height_, static_cast<std::uint32_t>(number)));
  addRgb(channels, "DiffDir", plane(width_, height_, 0.25F, 0.0F));
  addRgb(channels, "DiffCol", plane(width_, height_, kAlbedo, 0.0F));
  addRgb(channels, "Emit", plane(width_, height_, 0.0F, 2.0F));
  channels["Normal.X"] = plane(width_, height_, 0.0F, 0.0F);
  channels["Normal.Y"] = plane(width_, height_, 0.0F, 0.0F);
  channels["Normal.Z"] = plane(width_, height_, 1.0F, 0.0F);
  channels["Depth.Z"] = plane(width_, height_, kWallDepth, kBackgroundDepth);
  for (const char* name : {"Vector.X", "Vector.Y", "Vector.Z", "Vector.W"}) {
    channels[name] = plane(width_, height_, 0.0F, 0.0F);
  }
  writeEdited(frameFile(number), std::move(channels), edit);
}

void SyntheticSequence::writeReference(int number, const Edit& edit) const {
  Channels channels;
  addRgb(channels, "DiffInd", plane(width_, height_, kLight, 0.0F));
  addRgb(channels, "DiffDir", plane(width_, height_, 0.25F, 0.0F));
  writeEdited(folder_ / frameFileName("ref", number, "exr"), std::move(channels), edit);
}

void SyntheticSequence::writeCameras(int first, int last) const {
  nlohmann::json document;
  document["frames"] = nlohmann::json::array();
  for (int number = first; number <= last; ++number) {
    document["frames"].push_back(
        {{"frame", number}, {"view", kIdentity}, {"prev_view", kIdentity}, {"projection", kProjection}});
  }
  writeText(folder_ / "cameras.json", document.dump(1));
}

void SyntheticSequence::write(int first, int last) const {
  for (int number = first; number <= last; ++number) {
    writeFrame(number);
    writeReference(number);
  }
  writeCameras(first, last);
}

Frame projectFrame(int number, int width, int height) {
  Frame frame;
  frame.number = number;
  frame.indirect = Image(width, height, 3);
  frame.direct = Image(width, height, 3);
  frame.albedo = Image(width, height, 3);
  frame.normal = Image(width, height, 3);
  frame.motion = Image(width, height, 3);
  frame.emission = Image(width, height, 3);
  const Image light = noisyLight(width, height, static_cast<std::uint32_t>(number));
  for (int c = 0; c < 3; ++c) {
    copyPlane(light, frame.indirect, c);
    copyPlane(plane(width, height, 0.25F, 0.0F), frame.direct, c);
    copyPlane(plane(width, height, kAlbedo, 0.0F), frame.albedo, c);
    copyPlane(plane(width, height, 0.0F, 2.0F), frame.emission, c);
  }
  copyPlane(plane(width, height, 1.0F, 0.0F), frame.normal, 2);
  frame.depth = plane(width, height, kWallDepth, kBackgroundDepth);
  frame.camera.projection = glm::make_mat4(kProjection.data());
  return frame;
}

void writeChannels(const std::filesystem::path& file, const Channels& channels) {
  std::vector<ExrChannel> list;
  for (const auto& [name, image] : channels) {
    list.push_back({name, &image, 0, ExrType::Float});
  }
  writeExr(file, list);
}

void writeText(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file) << text;
}

std::string readText(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace walr::test
