#include "samples/sequence/sequence.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <utility>

#include "passes/conventions/camera_check.h"
#include "passes/conventions/light_pattern.h"
#include "samples/errors.h"
#include "samples/image/exr_limits.h"
#include "samples/sequence/cameras.h"
#include "samples/sequence/channel_map.h"

namespace walr {
namespace {

namespace fs = std::filesystem;

/// The number at the end of a file stem; nullopt if the stem does not end with a digit.
std::optional<int> frameNumber(const std::string& stem) {
  const auto lastOther = std::find_if(stem.rbegin(), stem.rend(), [](unsigned char c) { return std::isdigit(c) == 0; });
  const std::string digits(lastOther.base(), stem.end());
  constexpr std::size_t kMostDigits = 9;  // Any number of nine digits fits an int.
  if (digits.empty() || digits.size() > kMostDigits) {
    return std::nullopt;
  }
  return std::stoi(digits);
}

/// Whether a minus sign belongs to the number at the end of a file stem. One after a letter or digit is a hyphen.
bool isNegative(const std::string& stem) {
  const std::size_t sign = stem.find_last_not_of("0123456789");
  return sign != std::string::npos && stem[sign] == '-' &&
         (sign == 0 || std::isalnum(static_cast<unsigned char>(stem[sign - 1])) == 0);
}

/// Whether a file is an OpenEXR file by its name. Systems hide files that begin with a dot, such as the "._NAME" that
/// macOS leaves on other systems' disks.
bool isNamedExr(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension == ".exr" && !file.filename().string().starts_with('.');
}

using FilesByNumber = std::map<int, fs::path>;

void addFile(FilesByNumber& files, int number, const fs::path& path) {
  const auto [existing, isNew] = files.emplace(number, path);
  if (!isNew) {
    const auto [first, second] = std::minmax(existing->second, path);
    throw InputError("frame " + std::to_string(number) + " exists twice: " + first.string() + " and " +
                     second.string() + ". Keep one sequence per folder.");
  }
}

std::string text(const PixelRect& rect) {
  const auto pair = [](glm::ivec2 v, const char* between) {
    return std::to_string(v.x) + between + std::to_string(v.y);
  };
  return pair(rect.size, " x ") + " pixels" +
         (rect.corner == glm::ivec2(0) ? "" : " from (" + pair(rect.corner, ", ") + ") on");
}

/// The projection to the clip space of a part of the picture that a projection belongs to; the part may reach beyond
/// it.
glm::mat4 projectionTo(const PixelRect& part, const PixelRect& picture, const glm::mat4& projection) {
  if (part == picture) return projection;
  const glm::dvec2 scale = glm::dvec2(picture.size) / glm::dvec2(part.size);
  // The centre of the picture in clip space of the part, whose y is up.
  const glm::dvec2 centre = glm::dvec2(picture.corner - part.corner) + 0.5 * glm::dvec2(picture.size);
  const glm::dvec2 shift = (2.0 * centre / glm::dvec2(part.size) - 1.0) * glm::dvec2(1.0, -1.0);
  glm::dmat4 result(projection);
  for (int column = 0; column < 4; ++column) {
    for (int axis = 0; axis < 2; ++axis) {
      result[column][axis] = scale[axis] * result[column][axis] + shift[axis] * result[column][3];
    }
  }
  return glm::mat4(result);
}

void refuseNonFinite(const std::vector<NonFiniteChannel>& channels) {
  if (channels.empty()) {
    return;
  }
  const NonFiniteChannel& first = channels.front();
  throw InputError(
      first.file.string() + ": channel " + first.channel + " has " + std::to_string(first.count) +
      " value(s) that are not finite (NaN or infinity), the first at pixel (" + std::to_string(first.firstX) + ", " +
      std::to_string(first.firstY) + ")" +
      (channels.size() > 1 ? "; " + std::to_string(channels.size() - 1) + " more channel(s) have some, too" : "") +
      ". Fix the render, or use --non-finite replace to denoise the frame anyway.");
}

/// Sets the light of all pixels that have no sample to 0.
void clearUnsampled(Image& light, const LightPattern& pattern, glm::ivec2 offset) {
  for (int y = 0; y < light.height(); ++y) {
    for (int x = 0; x < light.width(); ++x) {
      if (pattern.hasSample({x, y}, offset)) continue;
      for (int c = 0; c < light.components(); ++c) light.at(x, y, c) = 0.0F;
    }
  }
}

}  // namespace

Sequence::Sequence(fs::path folder, SequenceOptions options)
    : folder_(std::move(folder)), options_(std::move(options)) {
  scan();
  checkHeaders();
  markCuts();
}

bool Sequence::hasReferences() const {
  return std::ranges::any_of(entries_, [](const Entry& entry) { return !entry.reference.empty(); });
}

std::string Sequence::assumption() const {
  if (options_.light.specular != SpecularWish::Denoised || layout_.hasSpecular(Role::SpecularDistance)) return {};
  return "specular light: the frames have no distances to what is reflected, which is taken to be far away, so that "
         "mirrors are less sharp";
}

void Sequence::scan() {
  std::error_code error;
  if (!fs::is_directory(folder_, error)) {
    throw InputError(folder_.string() + " is not a folder. Give the folder that holds the EXR frames.");
  }
  FilesByNumber frames;
  FilesByNumber references;
  FilesByNumber specular;
  fs::directory_iterator files(folder_, error);
  if (error) throw InputError("cannot read the folder " + folder_.string() + ": " + error.message());
  for (const fs::directory_entry& file : files) {
    const std::string stem = file.path().stem().string();
    const std::optional<int> number = frameNumber(stem);
    if (isNamedExr(file.path()) && number) {
      if (isNegative(stem)) {
        throw InputError(file.path().string() + " has a negative frame number; number the frames from 0 or more on");
      }
      FilesByNumber& kind = stem.starts_with("ref") ? references : stem.starts_with("specular") ? specular : frames;
      addFile(kind, *number, file.path());
    }
  }
  if (frames.empty()) {
    throw InputError(folder_.string() +
                     " holds no frames: no .exr file with a number of one to nine digits at the end of its name" +
                     (references.empty() ? ""
                                         : "; " + references.begin()->second.filename().string() +
                                               " is a reference, because its name begins with 'ref'") +
                     (specular.empty() ? ""
                                       : "; " + specular.begin()->second.filename().string() +
                                             " only tells of reflections, because its name begins with 'specular'"));
  }
  const FrameRange range = options_.frames.value_or(FrameRange{frames.begin()->first, std::prev(frames.end())->first});
  for (int number = range.first; number <= range.last; ++number) {
    const auto frame = frames.find(number);
    if (frame == frames.end()) {
      throw InputError("frame " + std::to_string(number) + " is missing in " + folder_.string() +
                       ", which has frames " + std::to_string(frames.begin()->first) + " to " +
                       std::to_string(std::prev(frames.end())->first) +
                       ". Every frame needs the one before it: render the missing frame, or choose a range without "
                       "gaps with --frames A-B.");
    }
    Entry entry;
    entry.number = number;
    entry.file = frame->second;
    if (const auto reference = references.find(number); reference != references.end()) {
      entry.reference = reference->second;
    }
    if (const auto found = specular.find(number); found != specular.end()) entry.specular = found->second;
    entries_.push_back(std::move(entry));
  }
}

void Sequence::checkHeaders() {
  std::map<int, Camera> cameras;
  for (Entry& entry : entries_) {
    const ExrReader file(entry.file, options_.stereoView);
    if (layout_.layout == nullptr) {
      layout_ = layoutOf(file);
      chooseSpecularFiles();
      lossy_ = file.lossy();
      denoiserLayout_ =
          options_.motionDepth ? withMotionDepth(*layout_.layout, *options_.motionDepth, entry.file) : *layout_.layout;
      denoiserLayout_.conventions.specular = options_.light.onlySpecular();
      displayWindow_ = file.displayWindow();
      place_ = file.dataWindow();
      if (layout_.layout->cameras == CameraSource::JsonFile) {
        cameras = readCameraFile(folder_ / "cameras.json");
      }
    }
    requireChannels(file, layout_, options_.light);
    checkDisplayWindow(file);
    if (layout_.specularFiles) {
      const ExrReader specular(entry.specular, options_.stereoView);
      requireSpecularFile(specular, layout_);
      checkDisplayWindow(specular);
    }
    entry.dataWindow = file.dataWindow();
    place_ = united(place_, entry.dataWindow);
    if (!entry.reference.empty()) {
      const ExrReader reference(entry.reference, options_.stereoView);
      requireReferenceChannels(reference, layout_, options_.light);
      checkDisplayWindow(reference);
    }
    if (layout_.layout->cameras == CameraSource::HeaderAttributes) {
      entry.camera = readCameraAttributes(file);
      readLight(file, entry);
    } else if (const auto camera = cameras.find(entry.number); camera != cameras.end()) {
      entry.camera = camera->second;
    } else {
      throw InputError((folder_ / "cameras.json").string() + " has no camera for frame " +
                       std::to_string(entry.number) + " (" + entry.file.filename().string() + ")");
    }
  }
  placeImages();
  if (!options_.keptLight.everyPixel()) keepSomeLight();
}

void Sequence::chooseSpecularFiles() {
  const auto has = [](const Entry& entry) { return !entry.specular.empty(); };
  const auto with = std::ranges::find_if(entries_, has);
  const bool wanted = options_.light.specular != SpecularWish::Nothing && !layout_.specular.empty();
  layout_.specularFiles = wanted && !layout_.layout->specularFile.empty() && with != entries_.end();
  if (!layout_.specularFiles) {
    for (Entry& entry : entries_) entry.specular.clear();
    return;
  }
  if (const auto without = std::ranges::find_if_not(entries_, has); without != entries_.end()) {
    throw InputError(with->specular.string() + " tells distances and roughness, but there is no such file for frame " +
                     std::to_string(without->number) + ". Export the missing frames again, or remove all such files.");
  }
  // What the files tell needs no pass of the frames.
  std::erase_if(layout_.specular, [&](const Plane& plane) {
    return std::ranges::find(layout_.layout->specularFile, plane.role, &Plane::role) !=
           layout_.layout->specularFile.end();
  });
}

RecognizedLayout Sequence::layoutOf(const ExrReader& file) const {
  if (options_.channelMap.empty()) return recognizeLayout(file, options_.viewLayer);
  if (!options_.viewLayer.empty()) {
    throw InputError(options_.channelMap.string() + ": a map of channels names whole channels, with the view layer '" +
                     options_.viewLayer + "' if they have it: give either --channels or --view-layer");
  }
  const auto map = std::make_shared<ChannelMap>();
  readChannelMap(options_.channelMap, *map);
  return mappedLayout(file, map);
}

void Sequence::placeImages() {
  try {
    requireWithinLimits(place_);
  } catch (const std::runtime_error& error) {
    throw InputError(folder_.string() + ": the data windows of its frames lie in a rectangle of " + text(place_) +
                     ": " + error.what() + ". Choose frames that lie nearer together with --frames A-B.");
  }
  const LightPattern& light = denoiserLayout_.conventions.light;
  for (Entry& entry : entries_) {
    entry.camera.projection = projectionTo(place_, displayWindow_, entry.camera.projection);
    entry.lightOffset =
        (entry.lightOffset + entry.dataWindow.corner - place_.corner) % glm::ivec2(light.columns, light.rows);
  }
}

void Sequence::keepSomeLight() {
  LightPattern& light = denoiserLayout_.conventions.light;
  if (!light.everyPixel()) {
    throw InputError(entries_.front().file.string() +
                     " has sparse light already. Denoise the frames without --light-rate, or take ones that have a "
                     "sample at every pixel.");
  }
  light = options_.keptLight;
  for (Entry& entry : entries_) {
    entry.lightOffset = lightOffsetOfFrame(light, static_cast<std::uint32_t>(entry.number));
  }
}

void Sequence::readLight(const ExrReader& file, Entry& entry) {
  if (!options_.light.indirect) return;  // All other light has samples at every pixel, or marks those that have none.
  const SparseLight light = readLightAttributes(file);
  if (&entry == &entries_.front()) denoiserLayout_.conventions.light = light.pattern;
  if (light.pattern != denoiserLayout_.conventions.light) {
    throw InputError(file.path().string() + ": its header attribute " + kLightGroupAttribute +
                     " differs from that of " + entries_.front().file.filename().string() +
                     ". All frames must have the same pixels per sample of light.");
  }
  if (options_.light.rest && options_.light.specular != SpecularWish::Denoised && !layout_.specular.empty() &&
      !light.pattern.everyPixel()) {
    throw InputError(file.path().string() + ": specular light has samples at some pixels only (header attribute " +
                     kLightGroupAttribute +
                     "), so a composite would have holes. Leave out --composite, or render without sparse light.");
  }
  entry.lightOffset = light.offset;
}

void Sequence::checkDisplayWindow(const ExrReader& file) const {
  if (file.displayWindow() == displayWindow_) return;
  throw InputError(file.path().string() + " is a picture (display window) of " + text(file.displayWindow()) + ", but " +
                   entries_.front().file.filename().string() + " is one of " + text(displayWindow_) +
                   ". All frames and references must belong to the same picture; only their data windows may differ.");
}

void Sequence::markCuts() {
  for (const int cut : options_.cuts) {
    const auto entry = std::ranges::find(entries_, cut, &Entry::number);
    if (entry == entries_.end()) {
      throw InputError("--cut " + std::to_string(cut) + ": there is no such frame; the sequence has frames " +
                       std::to_string(entries_.front().number) + " to " + std::to_string(entries_.back().number));
    }
    entry->camera.cut = true;
  }
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    Entry& entry = entries_[i];
    entry.camera.cut = i > 0 && (entry.camera.cut || !sameView(entry.camera.previousView, entries_[i - 1].camera.view));
    entry.resetHistory = i == 0 || entry.camera.cut;
  }
}

Frame Sequence::describe(std::size_t index) const {
  const Entry& entry = entries_[index];
  Frame frame;
  frame.number = entry.number;
  frame.camera = entry.camera;
  frame.resetHistory = entry.resetHistory;
  frame.light = denoiserLayout_.conventions.light;
  frame.lightOffset = entry.lightOffset;
  const Camera& previous = entries_[index > 0 ? index - 1 : 0].camera;
  frame.previousProjection = previous.projection;
  frame.previousJitter = previous.jitter;
  frame.previousLightOffset = entries_[index > 0 ? index - 1 : 0].lightOffset;

  frame.place = ImagePlace{place_, entry.dataWindow, displayWindow_};
  return frame;
}

Frame Sequence::read(std::size_t index) const {
  const Entry& entry = entries_[index];
  Frame frame = describe(index);
  ExrReader file(entry.file, options_.stereoView);
  checkDisplayWindow(file);
  readFrame(file, layout_, options_.light, place_, frame);
  if (!entry.specular.empty()) {
    ExrReader specular(entry.specular, options_.stereoView);
    checkDisplayWindow(specular);
    readSpecularFile(specular, layout_, place_, frame);
  } else if (options_.light.specular == SpecularWish::Denoised && frame.specularDistance.empty()) {
    frame.specularDistance = Image(place_.size.x, place_.size.y, 1);
    std::ranges::fill(frame.specularDistance.values(), kBackgroundDepth);
  }
  if (layout_.map != nullptr) convertByMap(*layout_.map, frame);
  if (!options_.keptLight.everyPixel()) {
    clearUnsampled(frame.indirect, frame.light, frame.lightOffset);
    if (options_.keepSomeDirect) clearUnsampled(frame.direct, frame.light, frame.lightOffset);
  }
  if (!entry.reference.empty()) {
    ExrReader reference(entry.reference, options_.stereoView);
    checkDisplayWindow(reference);
    frame.reference = readReference(reference, layout_, options_.light, place_, frame.nonFinite);
  }
  if (options_.nonFinite == NonFinitePolicy::Fail) {
    refuseNonFinite(frame.nonFinite);
  }
  return frame;
}

}  // namespace walr
