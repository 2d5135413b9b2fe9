#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "samples/command_line/arguments.h"
#include "samples/command_line/program.h"
#include "samples/command_line/resampled_frames.h"
#include "samples/command_line/usage_error.h"
#include "samples/denoise/progress.h"
#include "samples/host/default_extent.h"
#include "samples/host/headless.h"
#include "samples/host/host_options.h"
#ifdef WALR_SHADER_COMMANDS
#include "samples/host/shader_reloader.h"
#endif
#include "samples/image/file_output.h"
#include "samples/image/webp_animation.h"
#ifdef WALR_HOST_WINDOW
#include "samples/host/window/interactive.h"
#endif

namespace walr::host {
namespace {

constexpr int kLastFrame = 11;  // Of the frames that are rendered without a window if the user chooses none.

ViewConstants viewConstantsOf(fg::Extent extent, float stops) {
  const auto width = static_cast<int>(extent.width);
  return {.leftEdge = width / 3,
          .rightEdge = width - width / 3,
          .middleEdge = width / 2,
          .gain = 1.0F,
          .bias = 0.0F,
          .stops = stops};
}

/// What reloads shaders between frames; empty if the user does not ask for it.
ReloadShaders shaderReload(const HostOptions& options) {
#ifdef WALR_SHADER_COMMANDS
  if (!options.reloadShaders) return {};
  const auto reloader =
      std::make_shared<ShaderReloader>(WALR_SHADER_COMMANDS, WALR_SHADER_SOURCES, WALR_SHADER_SOURCES, std::cerr);
  return [reloader](const fg::GraphDesc& graph, fg::vk::Executor& executor) { return reloader->poll(graph, executor); };
#else
  (void)options;
  return {};
#endif
}

/// Call what declares a graph of the method on the command line.
/// @throws UsageError naming settings that contradict each other, or a method that does not take sparse light
auto asCommandLine(const auto& declares) {
  try {
    return declares();
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

void runHeadless(const HostOptions& options, float stops, Tracer& tracer, GpuDevice& gpu, Denoiser& method,
                 Denoiser& compared) {
  if (options.output.empty() && options.record.empty()) {
    throw UsageError(
        "without a window, frames are written to a folder or a file: give --output DIR or --record FILE.webp");
  }
  if (options.exr && options.output.empty()) {
    throw UsageError("--exr: EXR files are written to a folder: give --output DIR");
  }
  if (options.targetMilliseconds > 0.0) {
    throw UsageError("--target-ms: without a window, all frames have the size of --size");
  }
  if (options.once) throw UsageError("--once: without a window, frames are rendered once in any case");
  if (options.lint) throw UsageError("--lint: without a window, check frames of walr render with walr lint");
  const FrameRange frames = parseFrameRange(options.frames);
  const fg::Extent extent = options.tracer.extent;
  std::optional<WebpAnimation> animation;
  if (!options.record.empty()) {
    if (options.record.has_parent_path()) prepareOutputDirectory(options.record.parent_path());
    prepareOutputFile(options.record);
    animation.emplace(static_cast<int>(extent.width), static_cast<int>(extent.height), options.tracer.framesPerSecond);
  }
  Renderer::Options rendering;
  rendering.light = options.tracer.light;
  rendering.view = parseView(options.view);
  rendering.view.compared = &compared;
  rendering.viewConstants = viewConstantsOf(extent, stops);
  rendering.readComposite = options.exr;
  rendering.scene = tracer.gpuScene();
  rendering.specular = tracer.specular();
  Renderer renderer = asCommandLine([&] { return Renderer(gpu, method, extent, rendering); });
  if (!options.output.empty()) prepareOutputDirectory(options.output);
  Tracer::Request request;
  request.reference = rendering.view.needsReference();
  request.resampledFrames = options.resampledFrames;
  Progress progress(std::cerr, isatty(STDERR_FILENO) != 0, "frame",
                    static_cast<std::size_t>(frames.last - frames.first + 1), Progress::Clock::now());
  const ReloadShaders reload = shaderReload(options);
  TracedRays traced;
  renderFrames(tracer, renderer, frames, request, [&](const RenderedFrame& frame) {
    if (reload) reload(renderer.graph().desc(), renderer.executor());
    if (!options.output.empty()) writeRenderedFrame(frame, extent, options.output);
    if (animation) animation->add(frame.display);
    traced += frame.traced;
    progress.advance(Progress::Clock::now());
  });
  if (animation) animation->write(options.record);
  constexpr std::uint64_t kMegabyte = std::uint64_t{1} << 20U;
  std::cout << "rays: " << traced.rays << ", " << rateText(traced)
            << "\ndevice memory: " << renderer.executor().allocatedBytes() / kMegabyte << " MiB of the frame graph";
  if (tracer.gpuScene() != nullptr) std::cout << ", " << tracer.gpuScene()->bytes() / kMegabyte << " MiB of the scene";
  std::cout << std::endl;
}

/// The option that only the path tracer on the processor has, if one is used; otherwise empty.
std::string needsProcessor(const HostOptions& options) {
  if (!options.tracer.light.everyPixel()) return "--light-rate";
  return options.resampledFrames > 0 ? "--resampled-frames" : "";
}

/// Whether to open a window: the user has chosen neither `--headless` nor `--record`, and windows are available.
bool opensWindow(const HostOptions& options) {
  if (options.headless || !options.record.empty()) return false;
#ifdef WALR_HOST_WINDOW
  if (Window::available()) return true;
  std::cerr << "no display: running as with --headless\n";
#else
  std::cerr << "built without windows (GLFW and Dear ImGui were not found): running as with --headless\n";
#endif
  return false;
}

void run(HostOptions& options) {
  if (!options.size.empty()) options.tracer.extent = parseSize(options.size);
  const std::optional<float> exposure = parseExposure(options.exposure);
  if (!options.record.empty() && options.record.extension() != ".webp") {
    throw UsageError("--record " + options.record.string() + ": give a file that ends in .webp");
  }
  if (options.tracer.scene.empty()) options.tracer.scene = builtInScene();
  const LightKinds lights{.diffuse = true, .specular = options.tracer.specular};
  std::unique_ptr<Denoiser> method = makeMethod(options.method, lights);
  const MethodOptions compare = parseCompare(options.compare.empty() ? "none" : options.compare);
  std::unique_ptr<Denoiser> compared = makeMethod(compare, lights);
  if (!options.compare.empty()) options.view = "compare";
  const bool window = opensWindow(options);
#ifdef WALR_HOST_WINDOW
  if (window) {
    options.gpu = withWindows(options.gpu);
  }
#endif
  checkResampledFrames(options.resampledFrames, options.tracer.light, options.tracer.specular,
                       options.tracerChoice == TracerChoice::Gpu);
  std::string because;
  if (const std::string option = needsProcessor(options);
      !option.empty() && options.tracerChoice == TracerChoice::Auto) {
    options.tracerChoice = TracerChoice::Cpu;
    because = ", because the GPU's path tracer has no " + option;
  }
  options.gpu.rayQueries = mayTraceOnGpu(options.tracerChoice);
  GpuDevice gpu(options.gpu);
  if (options.size.empty()) options.tracer.extent = defaultExtent(window, gpu.physical().type);
  const TracerDecision decision = decideTracer(options.tracerChoice, gpu);
  Tracer tracer(options.tracer, decision.onGpu ? &gpu : nullptr);
  for (const std::string& warning : tracer.warnings()) {
    std::cerr << "warning: " << warning << '\n';
  }
  if (options.frames.empty()) {
    const int last = window ? std::max(kLastFrame, tracer.lastAnimationFrame()) : kLastFrame;
    options.frames = "0-" + std::to_string(last);
  }
  const float stops = exposure ? *exposure : tracer.exposure(parseFrameRange(options.frames).first);
  std::cout << "method: " << options.method.name;
  if (const std::optional<std::string> preset = presetInUse(options.method.name, *method)) {
    std::cout << ", preset " << *preset;
  }
  for (const auto& [name, shown] : {std::pair{options.method.name, method.get()}, {compare.name, compared.get()}}) {
    if (!tracer.specular() || shown->takesSpecularLight()) continue;
    std::cout << "\nspecular light: as it was traced where " << name << " denoises, which does not take it";
  }
  std::cout << "\ndevice: " << gpu.name() << ", driver " << gpu.driver() << "\ntracer: " << decision.text << because
            << std::endl;
  if (!window) {
    runHeadless(options, stops, tracer, gpu, *method, *compared);
  }
#ifdef WALR_HOST_WINDOW
  if (window) {
    Session session(tracer, options.method.name, std::move(method), parseView(options.view),
                    viewConstantsOf(options.tracer.extent, stops), parseFrameRange(options.frames), options.once);
    session.targetMilliseconds = options.targetMilliseconds;
    session.autoExposure = !exposure;
    session.resample = options.resampledFrames > 0;
    if (session.resample) session.resampledFrames = options.resampledFrames;
    session.chooseLint(options.lint);
    session.compareWith(compare.name, std::move(compared));
    asCommandLine([&] { runWindow(tracer, gpu, session, options.tracer.extent, shaderReload(options)); });
  }
#endif
  gpu.refuseMessages();
}

}  // namespace
}  // namespace walr::host

int main(int argc, char** argv) {
  CLI::App program("walr-host: path-traces a glTF scene; denoises, composites and tone-maps it in one frame graph",
                   "walr-host");
  program.set_version_flag("--version", WALR_VERSION);
  walr::host::HostOptions options;
  walr::host::addHostOptions(program, options);
  program.callback([&] { walr::host::run(options); });
  return walr::runProgram(program, argc, argv);
}
