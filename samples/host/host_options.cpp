#include "samples/host/host_options.h"

#include <map>
#include <string>

#include "samples/command_line/device_options.h"

namespace walr::host {

void addHostOptions(CLI::App& program, HostOptions& options) {
  Tracer::Options& tracer = options.tracer;
  program.add_option("SCENE", tracer.scene, "glTF 2.0 file, .gltf or .glb")->required();
  program.add_flag("--headless", options.headless,
                   "Open no window; write --frames to --output. So it is, too, where there is no display");
  program.add_option("-o,--output", options.output, "Without a window: folder for frame_FFFF.png; made if need be")
      ->type_name("DIR");
  program.add_flag("--exr", options.exr, "Also write frame_FFFF.exr, the linear lit picture in half floats");
  program.add_option("--frames", options.frames, "Frames of the scene's animation, both included")
      ->type_name("A-B")
      ->capture_default_str();
  program.add_flag("--once", options.once, "In a window: stop after the last frame instead of starting again");
  program.add_option("--size", options.size, "Size of the picture in pixels, 1 to 16384 each")
      ->type_name("WIDTHxHEIGHT")
      ->capture_default_str();
  program
      .add_option(
          "--view", options.view,
          "What is shown: denoised, noisy, reference, split (these three beside one another) or the name of a texture "
          "of the frame")
      ->type_name("VIEW")
      ->capture_default_str();
  addMethodOptions(program, options.method);
  addDeviceOptions(program, options.gpu);
  constexpr std::uint32_t kMostSamples = 1U << 16U;
  program.add_option("--spp", tracer.samples, "Samples per pixel")
      ->check(CLI::Range(1U, kMostSamples))
      ->capture_default_str();
  program
      .add_option("--reference-spp", tracer.referenceSamples,
                  "Samples per pixel of a reference, for the views that show one; they add up while nothing moves")
      ->check(CLI::Range(1U, kMostSamples))
      ->capture_default_str();
  constexpr std::uint32_t kMostBounces = 1024;
  program.add_option("--bounces", tracer.bounces, "Surfaces after the first that reflect light")
      ->check(CLI::Range(0U, kMostBounces))
      ->capture_default_str();
  program.add_option("--seed", tracer.seed, "Number of the random sequence")->capture_default_str();
  constexpr double kSlowest = 1e-3;
  constexpr double kFastest = 1e6;
  program.add_option("--fps", tracer.framesPerSecond, "Frames a second of the animation")
      ->check(CLI::Range(kSlowest, kFastest))
      ->capture_default_str();
  program.add_option("--camera", tracer.camera, "Name of the camera or of its node; default: the first");
  program.add_option("--sky", tracer.sky,
                     "Equirectangular sky in place of the scene's: an EXR file, R,G,B, its middle along -Z");
  program.add_flag("--jitter", tracer.jitter, "Sample off the pixel centre: 16 Halton points, one a frame");
  program.add_flag(
      "--denoise-direct", tracer.denoiseDirect,
      "Denoise the direct light with the indirect: for lamps and skies that one sample per pixel finds badly");
  program
      .add_option(
          "--gbuffer", tracer.gbuffer,
          "first-hit: depth, normal and albedo of the first surface; metals show no light. material: in mirrors "
          "those of what they show, on glossy metals albedos mixed (Fu 2022)")
      ->transform(CLI::CheckedTransformer(std::map<std::string, render::GBufferMode>{
          {"first-hit", render::GBufferMode::FirstHit}, {"material", render::GBufferMode::Material}}))
      ->type_name("")
      ->default_str("first-hit");
  program.add_option("--threads", tracer.threads, "Threads that trace; 0: one for every core")->capture_default_str();
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
  return {HostView::Kind::Texture, text};
}

}  // namespace walr::host
