#include "samples/sequence/writer.h"

#include <iomanip>
#include <sstream>
#include <vector>

#include "samples/image/exr.h"
#include "samples/sequence/cameras.h"

namespace walr {

std::string frameFileName(const std::string& prefix, int number, const std::string& extension) {
  std::ostringstream name;
  name << prefix << '_' << std::setw(4) << std::setfill('0') << number << '.' << extension;
  return name.str();
}

void writeFrame(const std::filesystem::path& directory, const Frame& frame) {
  std::vector<ExrChannel> channels;
  appendChannels(channels, "Indirect", "RGB", frame.indirect);
  if (!frame.direct.empty()) {
    appendChannels(channels, "Direct", "RGB", frame.direct);
  }
  appendChannels(channels, "Albedo", "RGB", frame.albedo);
  appendChannels(channels, "Normal", "XYZ", frame.normal);
  appendChannels(channels, "Depth", "Z", frame.depth, ExrType::Float);
  appendChannels(channels, "Motion", "XYZ", frame.motion);
  if (!frame.emission.empty()) {
    appendChannels(channels, "Emission", "RGB", frame.emission);
  }
  if (!frame.specular.empty()) {
    appendChannels(channels, "Specular", "RGB", frame.specular);
    appendChannels(channels, "SpecularDistance", "Z", frame.specularDistance, ExrType::Float);
    appendChannels(channels, "Roughness", "Y", frame.roughness);
    appendChannels(channels, "SpecularAlbedo", "RGB", frame.specularAlbedo);
    if (!frame.specularMotion.empty()) {
      appendChannels(channels, "SpecularMotion", "XYZ", frame.specularMotion, ExrType::Float);
    }
  }
  if (!frame.objectId.empty()) {
    appendChannels(channels, "ObjectId", "Y", frame.objectId, ExrType::Float);
  }
  std::vector<ExrAttribute> attributes = {
      {kViewAttribute, frame.camera.view},
      {kPreviousViewAttribute, frame.camera.previousView},
      {kProjectionAttribute, frame.camera.projection},
      {kJitterAttribute, frame.camera.jitter},
      {kCutAttribute, frame.camera.cut ? 1 : 0},
  };
  if (!frame.light.everyPixel()) {
    attributes.emplace_back(kLightGroupAttribute, glm::vec2(frame.light.columns, frame.light.rows));
    attributes.emplace_back(kLightOffsetAttribute, glm::vec2(frame.lightOffset));
  }
  writeExr(directory / frameFileName("noisy", frame.number, "exr"), channels, attributes);
}

void writeReference(const std::filesystem::path& directory, int number, const Reference& reference) {
  std::vector<ExrChannel> channels;
  appendChannels(channels, "Indirect", "RGB", reference.indirect);
  if (!reference.direct.empty()) {
    appendChannels(channels, "Direct", "RGB", reference.direct);
  }
  if (!reference.indirectHalf.empty()) {
    appendChannels(channels, "IndirectA", "RGB", reference.indirectHalf);
  }
  if (!reference.specular.empty()) {
    appendChannels(channels, "Specular", "RGB", reference.specular);
  }
  if (!reference.specularHalf.empty()) {
    appendChannels(channels, "SpecularA", "RGB", reference.specularHalf);
  }
  writeExr(directory / frameFileName("ref", number, "exr"), channels);
}

}  // namespace walr
