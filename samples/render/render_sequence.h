#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "samples/render/frame_tracer.h"
#include "samples/render/reference.h"
#include "samples/render/sampler.h"
#include "samples/render/scene.h"
#include "samples/sequence/sequence.h"

namespace walr::render {

/// The options of `walr render`.
struct RenderOptions {
  std::filesystem::path scene;
  std::filesystem::path sky;  ///< Equirectangular sky (`loadSky`) that replaces the scene's; may be empty.
  std::filesystem::path output;
  int firstFrame = 0;
  int lastFrame = 0;  ///< Included.
  std::uint32_t width = 320;
  std::uint32_t height = 180;
  std::uint32_t samples = 1;           ///< Samples per pixel of the noisy frames.
  std::uint32_t referenceSamples = 0;  ///< Samples per pixel of the references; 0: no references.
  /// Frames that get a reference; nullopt: all frames.
  std::optional<FrameRange> referenceFrames = {};
  ReferenceCoverage referenceCoverage = {};
  std::uint32_t bounces = 4;  ///< Surfaces after the first that reflect light.
  /// Indirect light of noisy frames is resampled from as many earlier frames (`resample`); 0: from none.
  std::uint32_t resampledFrames = 0;
  std::uint32_t seed = 0;
  double framesPerSecond = 24.0;
  std::string camera;                                ///< Name of the camera or of its node; empty: the first camera.
  bool jitter = false;                               ///< Offset sample positions by `haltonJitter`.
  Sampler::Kind sampler = Sampler::Kind::BlueNoise;  ///< BlueNoise: Sobol if there are several samples per pixel.
  LightPattern light = {};                           ///< Which pixels of the noisy frames have indirect light.
  unsigned int threads = 0;                          ///< Number of threads; 0: one per core.
  DiffuseModel diffuseModel = DiffuseModel::Lambert;
  bool replaceMirrors = false;  ///< `GBufferMode::BehindMirrors`; only with `specular`.
  bool specular = false;        ///< See `Scene::specular`; frames and references then hold specular light.
  /// Makes another path tracer than that on the processor; empty: the processor's.
  std::function<std::unique_ptr<FrameTracer>(const World&)> otherTracer = {};

  /// Whether a frame gets a reference.
  [[nodiscard]] bool hasReference(int frame) const;
  /// Number of frames that get a reference.
  [[nodiscard]] std::size_t references() const;
  /// Number of files that are rendered.
  [[nodiscard]] std::size_t files() const;
  /// Paths to trace for a noisy frame, whose G-buffer counts as one per pixel; for a reference; and for all files.
  [[nodiscard]] double noisyPaths() const;
  [[nodiscard]] double referencePaths() const;
  [[nodiscard]] double paths() const;
};

/// Callbacks that report the progress of rendering.
struct RenderObserver {
  /// Number of paths traced since the last call. Called by one thread at a time.
  std::function<void(double)> traced = [](double) {};
  /// Number of paths that need not be traced, because their file exists already.
  std::function<void(double)> skipped = [](double) {};
  /// A file was rendered, or exists already; with one line about it. Called `RenderOptions::files` times.
  std::function<void(const std::string&)> fileDone = [](const std::string&) {};
  /// See `Scene::warnings`.
  std::function<void(const std::string&)> warning = [](const std::string&) {};
};

/// Render frames of a scene's camera animation to `output` in the project's layout (samples/docs/sequences.md):
/// noisy_FFFF.exr and, if requested, ref_FFFF.exr. Frame F shows the time F / framesPerSecond. Existing files are
/// skipped, so that an interrupted run can be resumed. With resampling, existing frames before a missing one are traced
/// again but not written, because it depends on them. The settings are stored in `render.json` in the same folder.
/// @throws SceneError  if the scene cannot be rendered
/// @throws InputError  if `output` holds frames of other settings
/// @throws OutputError if a file cannot be written
void renderSequence(const RenderOptions& options, const RenderObserver& observer);

}  // namespace walr::render
