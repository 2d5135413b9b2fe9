#include <unistd.h>

#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "samples/cli/arguments.h"
#include "samples/cli/program.h"
#include "samples/cli/usage_error.h"
#include "samples/denoise/progress.h"
#include "samples/host/headless.h"
#include "samples/host/host_options.h"
#include "samples/image/file_output.h"

namespace walr::host {
namespace {

ViewConstants viewConstantsOf(fg::Extent extent) {
  const auto width = static_cast<int>(extent.width);
  return {.leftEdge = width / 3, .rightEdge = width - width / 3, .gain = 1.0F, .bias = 0.0F};
}

void runHeadless(const HostOptions& options, Tracer& tracer, GpuDevice& gpu, Denoiser& method) {
  if (options.output.empty()) {
    throw UsageError("without a window the frames go to a folder: give --output DIR");
  }
  const FrameRange frames = parseFrameRange(options.frames);
  const fg::Extent extent = options.tracer.extent;
  Renderer::Options rendering;
  rendering.view = parseView(options.view);
  rendering.viewConstants = viewConstantsOf(extent);
  rendering.readComposite = options.exr;
  Renderer renderer(gpu, method, extent, rendering);
  prepareOutputDirectory(options.output);
  Tracer::Request request;
  request.reference = rendering.view.needsReference();
  Progress progress(std::cerr, isatty(STDERR_FILENO) != 0, "frame",
                    static_cast<std::size_t>(frames.last - frames.first + 1), Progress::Clock::now());
  renderFrames(tracer, renderer, frames, request, [&](const RenderedFrame& frame) {
    writeRenderedFrame(frame, extent, options.output);
    progress.advance(Progress::Clock::now());
  });
}

void run(HostOptions& options) {
  options.tracer.extent = parseSize(options.size);
  const std::unique_ptr<Denoiser> method = makeMethod(options.method);
  Tracer tracer(options.tracer);
  for (const std::string& warning : tracer.warnings()) {
    std::cerr << "warning: " << warning << '\n';
  }
  GpuDevice gpu(options.gpu);
  std::cout << "method: " << options.method.name << "\ndevice: " << gpu.name() << ", driver " << gpu.driver()
            << std::endl;
  runHeadless(options, tracer, gpu, *method);
  gpu.refuseMessages();
}

}  // namespace
}  // namespace walr::host

int main(int argc, char** argv) {
  CLI::App program(
      "walr-host: path-traces a glTF scene, denoises it in the same frame graph as it composites and tone-maps in",
      "walr-host");
  program.set_version_flag("--version", WALR_VERSION);
  walr::host::HostOptions options;
  walr::host::addHostOptions(program, options);
  program.callback([&] { walr::host::run(options); });
  return walr::runProgram(program, argc, argv);
}
