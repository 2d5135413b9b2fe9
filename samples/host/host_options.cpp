#include "samples/host/host_options.h"

#include <stdexcept>
#include <string>

#include "samples/command_line/arguments.h"
#include "samples/command_line/choice.h"
#include "samples/command_line/device_options.h"
#include "samples/command_line/light_rate.h"
#include "samples/command_line/resampled_frames.h"
#include "samples/command_line/tracing_options.h"
#include "samples/command_line/usage_error.h"

namespace walr::host {

void addHostOptions(CLI::App& program, HostOptions& options) {
  Tracer::Options& tracer = options.tracer;
  program.add_option("SCENE", tracer.scene, "glTF 2.0 file, .gltf or .glb; default: a kitchen that comes with walr");
  program.add_flag("--headless", options.headless,
                   "Open no window; write --frames to --output. The same happens if there is no display");
  program.add_option("-o,--output", options.output, "Without a window: folder for frame_FFFF.png; created if missing")
      ->type_name("DIR");
  program
      .add_option("--record", options.record,
                  "Open no window; write the frames as one animation in WebP, which browsers play")
      ->type_name("FILE.webp");
  program.add_flag("--exr", options.exr, "Also write frame_FFFF.exr, the linear lit image in half floats");
  program
      .add_option("--frames", options.frames,
                  "First and last frame of the scene's animation; default: in a window all of it, otherwise 0-11")
      ->type_name("A-B");
  program.add_flag("--once", options.once, "In a window: stop after the last frame instead of starting again");
  program.add_flag("--lint", options.lint,
                   "In a window: check the inputs of the denoiser, and list below the panel what looks wrong");
  program
      .add_option("--size", options.size,
                  "Size of the image in pixels, 1 to 16384 each; default: in a window on a discrete or integrated GPU "
                  "1920x1080, otherwise 640x360")
      ->type_name("WIDTHxHEIGHT");
  CLI::Option* const view =
      program
          .add_option("--view", options.view,
                      "What is shown: denoised, noisy, reference, split (noisy, denoised and reference side by side), "
                      "compare (denoised and noisy) or the name of a texture of the frame")
          ->type_name("VIEW")
          ->capture_default_str();
  program
      .add_option("--compare", options.compare,
                  "Show a second method on the right of an edge, on the same rays; with its first preset or another")
      ->excludes(view)
      ->type_name("METHOD[:PRESET]");
  program
      .add_option("--exposure", options.exposure,
                  "Exposure of the lit image in stops: a number, or auto, which maps the log-average luminance of the "
                  "first frame to middle grey (Reinhard et al. 2002)")
      ->type_name("auto|EV")
      ->capture_default_str();
  constexpr double kLongest = 1e4;
  program
      .add_option(
          "--target-ms", options.targetMilliseconds,
          "In a window: hold the time of a frame, the longer of tracing on the processor and all passes on the "
          "device, by smaller pictures. Above this time or below 80 % of it, the number of pixels changes; sides "
          "stay between half and all of --size")
      ->check(numberFrom(0.0, kLongest))
      ->type_name("MS");
#ifdef WALR_SHADER_COMMANDS
  program.add_flag("--reload-shaders", options.reloadShaders,
                   "Watch the sources of the denoiser's shaders, compile what changes and use it in the next frame");
#endif
  addMethodOptions(program, options.method);
  addDeviceOptions(program, options.gpu);
  constexpr std::uint32_t kMostSamples = 1U << 16U;
  program.add_option("--spp", tracer.samples, "Samples per pixel")
      ->check(CLI::Range(1U, kMostSamples))
      ->capture_default_str();
  addLightRate(program, tracer.light,
               "Share of the pixels that have a sample of indirect light in a frame: 1, 1/2 (a checkerboard), 1/4 (one "
               "of 2 x 2) or 1/9 (one of 3 x 3). Which pixels these are changes from frame to frame");
  addResampledFrames(program, options.resampledFrames);
  program
      .add_option("--reference-spp", tracer.referenceSamples,
                  "Samples per pixel that a frame adds to the reference, for views that show it; samples accumulate "
                  "while nothing moves")
      ->check(CLI::Range(1U, kMostSamples))
      ->capture_default_str();
  addTracingOptions(program, tracer);
  addChoice<bool, bool>(
      program, "--direct", tracer.denoiseDirect, {{"denoised", true}, {"noisy", false}}, "denoised",
      "Direct light: denoised together with the indirect light, or noisy as it was traced. Lamps and skies "
      "are noisy at one sample per pixel");
  program.add_flag("--specular", tracer.specular,
                   "Materials reflect with the specular lobe of glTF, too; methods that take its light denoise it");
  program
      .add_flag_callback(
          "--replace-mirrors", [&tracer] { tracer.gbuffer = render::GBufferMode::BehindMirrors; },
          "Metals (metallic of at least 0.95) of a linear roughness below 0.15 are mirrors: their pixels hold the "
          "virtual image of the surface that they reflect, whose light is denoised; the mirrors are taken to stand "
          "still")
      ->needs("--specular");
  program.add_option("--threads", tracer.threads, "Threads for --tracer cpu; 0: one per core")->capture_default_str();
  addTracerOption(program, options.tracerChoice);
}

std::filesystem::path builtInScene() {
  const std::filesystem::path folder = std::filesystem::canonical("/proc/self/exe").parent_path();
  // Beside bin in the build, and beside libexec in the bundle.
  std::filesystem::path scene = folder.parent_path() / "samples/scenes/kitchen.gltf";
  if (std::filesystem::exists(scene)) return scene;
  throw UsageError(
      "samples/scenes/kitchen.gltf, which comes with walr, was not found from the program's folder: name a scene, as "
      "in "
      "walr-host SCENE.glb");
}

MethodOptions parseCompare(const std::string& text) {
  const std::size_t colon = text.find(':');
  MethodOptions method;
  method.name = text.substr(0, colon);
  if (colon != std::string::npos) method.preset = text.substr(colon + 1);
  try {
    const std::unique_ptr<Denoiser> made = makeDenoiser(method.name);
    if (!method.preset.empty()) made->usePreset(method.preset);
  } catch (const std::invalid_argument& error) {
    throw UsageError("--compare " + text + ": " + error.what());
  }
  return method;
}

HostView parseView(const std::string& text) {
  if (text == "denoised") {
    return {HostView::Kind::Denoised, ""};
  }
  if (text == "noisy") {
    return {HostView::Kind::Noisy, ""};
  }
  if (text == "reference") {
    return {HostView::Kind::Reference, ""};
  }
  if (text == "split") {
    return {HostView::Kind::Split, ""};
  }
  if (text == "compare") {
    return {HostView::Kind::Compare, ""};
  }
  return {HostView::Kind::Texture, text};
}

}  // namespace walr::host
