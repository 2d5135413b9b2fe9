#include <unistd.h>

#include <iostream>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "framegraph/vulkan/error.h"
#include "samples/cli/command.h"
#include "samples/command_line/arguments.h"
#include "samples/command_line/choice.h"
#include "samples/command_line/device_options.h"
#include "samples/command_line/exit_code.h"
#include "samples/command_line/light_rate.h"
#include "samples/command_line/resampled_frames.h"
#include "samples/command_line/tracer_option.h"
#include "samples/command_line/tracing_options.h"
#include "samples/command_line/usage_error.h"
#include "samples/denoise/gpu_device.h"
#include "samples/denoise/progress.h"
#include "samples/gpu_render/film_tracer.h"
#include "samples/render/render_sequence.h"

namespace walr {
namespace {

struct RenderArguments {
  render::RenderOptions options;
  std::string frames = "0-11";
  std::string referenceFrames;
  std::string size = "320x180";
  TracerChoice tracer = TracerChoice::Cpu;
  GpuDevice::Options gpu;
};

/// The device to trace on; null for the processor. Says on the terminal which of the two it is, if that was a choice.
std::unique_ptr<GpuDevice> tracingDevice(const RenderArguments& arguments) {
  if (!mayTraceOnGpu(arguments.tracer)) {
    if (arguments.gpu.validation || !arguments.gpu.device.empty()) {
      throw UsageError("--device and --validate are of a Vulkan device: give --tracer gpu or auto, too");
    }
    return nullptr;
  }
  GpuDevice::Options options = arguments.gpu;
  options.rayQueries = true;
  try {
    auto gpu = std::make_unique<GpuDevice>(options);
    const TracerDecision decision = decideTracer(arguments.tracer, *gpu);
    std::cerr << "tracer: " << decision.text << ", device " << gpu->name() << ", driver " << gpu->driver() << '\n';
    if (decision.onGpu) return gpu;
  } catch (const fg::vk::Unsupported& error) {
    if (arguments.tracer == TracerChoice::Gpu) throw;
    std::cerr << "tracer: CPU (Embree), because there is no suitable Vulkan device: " << error.what() << '\n';
  }
  return nullptr;
}

void renderFrames(RenderArguments& arguments) {
  render::RenderOptions& options = arguments.options;
  const FrameRange frames = parseFrameRange(arguments.frames);
  const fg::Extent extent = parseSize(arguments.size);
  options.firstFrame = frames.first;
  options.lastFrame = frames.last;
  if (!arguments.referenceFrames.empty()) {
    options.referenceFrames = parseFrameRange(arguments.referenceFrames, "--reference-frames");
  }
  if (options.referenceSamples > 0 && options.references() == 0) {
    throw UsageError("--reference-frames " + arguments.referenceFrames + ": none of them is one of --frames " +
                     arguments.frames);
  }
  options.width = extent.width;
  options.height = extent.height;

  const std::unique_ptr<GpuDevice> gpu = tracingDevice(arguments);
  checkResampledFrames(options.resampledFrames, options.light, options.specular, gpu != nullptr);
  if (gpu) {
    options.otherTracer = [&gpu](const render::World& world) {
      return std::make_unique<gpu_render::FilmTracer>(*gpu, world);
    };
  }
  Progress progress(std::cerr, isatty(STDERR_FILENO) != 0, "file", options.files(), Progress::Clock::now(),
                    options.paths());
  render::RenderObserver observer;
  observer.warning = [&](const std::string& warning) { progress.note("warning: " + warning); };
  observer.traced = [&](double paths) { progress.worked(paths, Progress::Clock::now()); };
  observer.skipped = [&](double paths) { progress.skipped(paths); };
  observer.fileDone = [&](const std::string& line) {
    progress.note(line);
    progress.advance(Progress::Clock::now());
  };
  renderSequence(options, observer);
  if (gpu) gpu->refuseMessages();
}

}  // namespace

void registerRender(CLI::App& program) {
  const auto arguments = std::make_shared<RenderArguments>();
  render::RenderOptions& options = arguments->options;
  CLI::App* command =
      program.add_subcommand("render", "Path-trace frames of a glTF scene's camera animation, noisy and as references");
  command->add_option("SCENE", options.scene, "glTF 2.0 file, .gltf or .glb")->required();
  command
      ->add_option(
          "-o,--output", options.output,
          "Folder for noisy_FFFF.exr and ref_FFFF.exr (samples/docs/sequences.md). Existing frames are kept, so "
          "an interrupted run can be resumed")
      ->required();
  command->add_option("--frames", arguments->frames, "A-B: first and last frame to render")->capture_default_str();
  command->add_option("--size", arguments->size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  constexpr std::uint32_t kMostSamples = 1U << 20U;
  command->add_option("--spp", options.samples, "Samples per pixel of the noisy frames")
      ->check(CLI::Range(1U, kMostSamples))
      ->capture_default_str();
  addLightRate(*command, options.light,
               "Share of the pixels of a noisy frame that have indirect light: 1, 1/2 (a checkerboard), 1/4 (one of "
               "2 x 2) or 1/9 (one of 3 x 3). Which pixels these are changes from frame to frame. References have "
               "light at every pixel");
  command->add_option("--reference-spp", options.referenceSamples, "Samples per pixel of the references; 0: none")
      ->check(CLI::Range(0U, kMostSamples))
      ->capture_default_str();
  command->add_option("--reference-frames", arguments->referenceFrames,
                      "A-B: first and last frame that get a reference; default: all");
  addChoice<bool, bool>(*command, "--reference-pixel", options.referenceCoverage.wholePixel,
                        {{"point", false}, {"area", true}}, "point",
                        "Value of a reference pixel: point (light at the frame's sample position) or area (mean over "
                        "the pixel, which anti-aliasing converges to)");
  constexpr std::uint32_t kFewestSquares = 4096;
  command
      ->add_option(
          "--reference-one-square-in", options.referenceCoverage.oneSquareIn,
          "Render the reference of one in N squares of 64 x 64 pixels, evenly spread; errors leave out the rest")
      ->check(CLI::Range(1U, kFewestSquares))
      ->capture_default_str();
  addTracingOptions(*command, options);
  addResampledFrames(*command, options.resampledFrames);
  using render::DiffuseModel;
  using Kind = render::Sampler::Kind;
  addChoice<Kind, Kind>(
      *command, "--sampler", options.sampler,
      {{"blue-noise", Kind::BlueNoise}, {"sobol", Kind::Sobol}, {"independent", Kind::Independent}}, "blue-noise",
      "Random numbers: blue-noise (spread over the pixels of a frame; with several samples per pixel, sobol is used "
      "instead), sobol (Owen-scrambled Sobol points over the samples of a pixel) or independent");
  addChoice<DiffuseModel, DiffuseModel>(
      *command, "--diffuse", options.diffuseModel,
      {{"lambert", DiffuseModel::Lambert}, {"disney", DiffuseModel::Disney}}, "lambert",
      "Diffuse lobe of all materials: lambert, or disney, the one of Blender's Principled BSDF");
  command->add_flag("--specular", options.specular,
                    "Materials reflect with the specular lobe of glTF, too: frames and references also hold its light, "
                    "distances, roughness and albedo");
  command
      ->add_flag("--replace-mirrors", options.replaceMirrors,
                 "Metals (metallic of at least 0.95) of a linear roughness below 0.15 are mirrors: their pixels hold "
                 "the virtual image of the surface that they reflect, in all channels; the mirrors are taken to stand "
                 "still")
      ->needs("--specular");
  command->add_option("--threads", options.threads, "Number of threads for --tracer cpu; 0: one per core")
      ->capture_default_str();
  addTracerOption(*command, arguments->tracer);
  addDeviceOptions(*command, arguments->gpu);
  command->footer(kExitCodeHelp);
  command->callback([=] {
    for (const char* const option : {"--reference-frames", "--reference-pixel", "--reference-one-square-in"}) {
      if (command->count(option) > 0 && arguments->options.referenceSamples == 0) {
        throw UsageError(std::string(option) + ": there are no references without --reference-spp");
      }
    }
    renderFrames(*arguments);
  });
}

}  // namespace walr
