#include "samples/render/render_sequence.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iomanip>
#include <sstream>

#include <nlohmann/json.hpp>

#include "samples/errors.h"
#include "samples/image/exr.h"
#include "samples/image/file_output.h"
#include "samples/image/fingerprint.h"
#include "samples/json_text.h"
#include "samples/render/film.h"
#include "samples/render/load_scene.h"
#include "samples/render/sequence_frame.h"
#include "samples/sequence/writer.h"

namespace walr::render {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSettingsFile = "render.json";

const char* nameOf(Sampler::Kind kind) {
  switch (kind) {
    case Sampler::Kind::Sobol:
      return "sobol";
    case Sampler::Kind::BlueNoise:
      return "blue-noise";
    case Sampler::Kind::Independent:
      break;
  }
  return "independent";
}

// Not in the settings of earlier versions, which had no such light.
constexpr const char* kSpecularKey = "specular";
constexpr const char* kMirrorsKey = "replace_mirrors";

// Only in the settings of the tracer on the GPU, whose frames differ from the processor's by rounding.
constexpr const char* kTracerKey = "tracer";

constexpr const char* kContentsKey = "scene_contents";

// The settings that pixels depend on. The range of frames is left out, because more frames may be added later.
nlohmann::json describe(const RenderOptions& options, const std::string& contents) {
  nlohmann::json settings = {
      {"scene", options.scene.filename().string()},
      {"scene_bytes", fs::file_size(options.scene)},
      {kContentsKey, contents},
      {"sky", options.sky.filename().string()},
      {"width", options.width},
      {"height", options.height},
      {"spp", options.samples},
      {"reference_spp", options.referenceSamples},
      {"reference_pixel", options.referenceCoverage.wholePixel ? "area" : "point"},
      {"reference_one_square_in", options.referenceCoverage.oneSquareIn},
      {"bounces", options.bounces},
      {"resampled_frames", options.resampledFrames},
      {"seed", options.seed},
      {"fps", options.framesPerSecond},
      {"camera", options.camera},
      {"jitter", options.jitter},
      {"diffuse", options.diffuseModel == DiffuseModel::Lambert ? "lambert" : "disney"},
      {"sampler", nameOf(options.sampler)},
      {"light_group", {options.light.columns, options.light.rows}},
  };
  if (options.specular) settings[kSpecularKey] = true;
  if (options.replaceMirrors) settings[kMirrorsKey] = true;
  if (options.otherTracer) settings[kTracerKey] = "gpu";
  return settings;
}

// Ensures that all frames of a folder have the same settings: writes them, or compares them with those in the folder.
void matchSettings(const RenderOptions& options, const std::string& contents) {
  const fs::path file = options.output / kSettingsFile;
  const nlohmann::json settings = describe(options, contents);
  std::error_code error;
  if (!fs::exists(file, error)) {
    const std::string text = jsonText(settings, 2);
    writeFileAtomically(file, text);
    return;
  }
  std::ifstream stream(file);
  const nlohmann::json before = nlohmann::json::parse(stream, nullptr, false);
  const auto refuse = [&](const std::string& key) {
    throw InputError(file.string() + ": the frames in this folder were rendered with a different '" + key +
                     "'; use another --output or remove the folder");
  };
  for (const auto& [key, value] : settings.items()) {
    if (key == kContentsKey) continue;
    const bool same = before.is_object() && before.contains(key) && before[key] == value;
    if (!same) refuse(key);
  }
  // Folders of earlier versions lack the contents.
  if (before.contains(kContentsKey) && before[kContentsKey] != contents) {
    throw InputError(file.string() + ": the files of the scene '" + options.scene.string() +
                     "' or of its sky have changed since the frames in this folder were rendered; use another --output "
                     "or remove the folder");
  }
  for (const char* const key : {kSpecularKey, kMirrorsKey, kTracerKey}) {
    if (before.contains(key) && !settings.contains(key)) refuse(key);
  }
}

std::string describeWork(const std::string& file, double seconds, std::uint64_t rays) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << file << ": " << seconds << " s, "
       << static_cast<double>(rays) / seconds * 1e-6 << " million rays/s";
  return text.str();
}

// Renders one file of a frame, unless it exists and is complete.
// @param paths   number of paths that the file needs, for the observer
// @param render  writes the file; returns the number of rays it traced
void renderFile(const fs::path& file, double paths, const RenderObserver& observer,
                const std::function<std::uint64_t()>& render) {
  const std::string name = file.filename().string();
  if (isCompleteExr(file)) {
    observer.skipped(paths);
    observer.fileDone(name + ": already exists, skipped");
    return;
  }
  const auto start = std::chrono::steady_clock::now();
  const std::uint64_t rays = render();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  observer.fileDone(describeWork(name, seconds.count(), rays));
}

// The last noisy frame that is not complete; the one before the first frame if all are.
int lastIncompleteFrame(const RenderOptions& options) {
  int frame = options.lastFrame;
  while (frame >= options.firstFrame && isCompleteExr(options.output / frameFileName("noisy", frame, "exr"))) --frame;
  return frame;
}

// Reservoirs hold light of all frames before. Frames that earlier calls wrote are traced again, back to the first gap.
int firstFrameOfReservoirs(const RenderOptions& options) {
  int frame = options.firstFrame;
  while (frame > 0 && isCompleteExr(options.output / frameFileName("noisy", frame - 1, "exr"))) --frame;
  return frame;
}

}  // namespace

bool RenderOptions::hasReference(int frame) const {
  const bool named = !referenceFrames || (referenceFrames->first <= frame && frame <= referenceFrames->last);
  return referenceSamples > 0 && named;
}

double RenderOptions::noisyPaths() const {
  return static_cast<double>(width) * height * (samples + 1.0);
}

double RenderOptions::referencePaths() const {
  return static_cast<double>(width) * height * referenceSamples / referenceCoverage.oneSquareIn;
}

std::size_t RenderOptions::references() const {
  if (referenceSamples == 0) return 0;
  const FrameRange named = referenceFrames.value_or(FrameRange{firstFrame, lastFrame});
  const std::int64_t count = std::int64_t{std::min(named.last, lastFrame)} - std::max(named.first, firstFrame) + 1;
  return static_cast<std::size_t>(std::max<std::int64_t>(count, 0));
}

double RenderOptions::paths() const {
  const double frames = static_cast<double>(lastFrame) - firstFrame + 1.0;
  return frames * noisyPaths() + static_cast<double>(references()) * referencePaths();
}

std::size_t RenderOptions::files() const {
  return static_cast<std::size_t>(std::int64_t{lastFrame} - firstFrame + 1) + references();
}

void renderSequence(const RenderOptions& options, const RenderObserver& observer) {
  Fingerprint contents;
  Scene scene = loadScene(options.scene, options.sky, &contents);
  scene.diffuseModel = options.diffuseModel;
  scene.specular = options.specular;
  std::for_each(scene.warnings.begin(), scene.warnings.end(), observer.warning);
  const std::uint32_t camera = findCamera(scene, options.camera);
  prepareOutputDirectory(options.output);
  matchSettings(options, contents.text());

  World world(scene, options.otherTracer ? RayCasting::None : RayCasting::Embree);
  const std::unique_ptr<FrameTracer> tracer =
      options.otherTracer ? options.otherTracer(world) : std::make_unique<ProcessorTracer>(world);
  std::optional<Reservoirs> reservoirs;
  if (options.resampledFrames > 0) {
    reservoirs.emplace(options.width, options.height, static_cast<float>(options.resampledFrames));
  }
  const int lastIncomplete = lastIncompleteFrame(options);
  const bool retraces = reservoirs && lastIncomplete >= options.firstFrame;
  const int first = retraces ? firstFrameOfReservoirs(options) : options.firstFrame;
  for (int number = first; number <= options.lastFrame; ++number) {
    world.moveTo(number / options.framesPerSecond, (number - 1) / options.framesPerSecond);
    const auto jitter = [&](int frame) { return options.jitter ? haltonJitter(frame) : glm::vec2(0.0F); };
    const View view = viewFrom(world, camera, options.width, options.height, jitter(number), jitter(number - 1));
    // Noisy frames and references never share a random sequence: their seeds differ in the lowest bit.
    const auto sampling = [&](std::uint32_t samples, double paths, std::uint32_t seedBit) {
      SamplingSettings settings;
      settings.samples = samples;
      settings.bounces = options.bounces;
      if (options.replaceMirrors) settings.gbuffer = GBufferMode::BehindMirrors;
      settings.seed = options.seed * 2 + seedBit;
      settings.firstSample = static_cast<std::uint32_t>(number) * samples;
      // With several samples per pixel, blue noise would be no better than independent samples, but Sobol points are.
      const bool spread = options.sampler == Sampler::Kind::BlueNoise && samples == 1;
      settings.sampler =
          options.sampler == Sampler::Kind::BlueNoise && !spread ? Sampler::Kind::Sobol : options.sampler;
      settings.threads = options.threads;
      const double pathsOfPixel = paths / (static_cast<double>(options.width) * options.height);
      settings.pixelsDone = [&observer, pathsOfPixel](std::uint64_t pixels) {
        observer.traced(pathsOfPixel * static_cast<double>(pixels));
      };
      return settings;
    };
    SamplingSettings noisy = sampling(options.samples, options.noisyPaths(), 0);
    noisy.light = options.light;
    noisy.lightOffset = lightOffsetOfFrame(options.light, static_cast<std::uint32_t>(number));
    noisy.reservoirs = reservoirs ? &*reservoirs : nullptr;
    const fs::path noisyFile = options.output / frameFileName("noisy", number, "exr");
    if (reservoirs && number < lastIncomplete && isCompleteExr(noisyFile)) {
      // Later frames need its reservoirs. Its paths are counted as skipped.
      SamplingSettings again = noisy;
      again.pixelsDone = [](std::uint64_t) {};
      tracer->film(view, again);
    }
    if (number < options.firstFrame) continue;
    renderFile(noisyFile, options.noisyPaths(), observer, [&] {
      const Film film = tracer->film(view, noisy);
      Frame frame = toFrame(film, view, number);
      frame.light = noisy.light;
      frame.lightOffset = noisy.lightOffset;
      writeFrame(options.output, frame);
      return film.rays;
    });
    if (!options.hasReference(number)) continue;
    renderFile(options.output / frameFileName("ref", number, "exr"), options.referencePaths(), observer, [&] {
      std::uint64_t rays = 0;
      const SamplingSettings settings = sampling(options.referenceSamples, options.referencePaths(), 1);
      writeReference(options.output, number, tracer->reference(view, settings, options.referenceCoverage, rays));
      return rays;
    });
  }
}

}  // namespace walr::render
