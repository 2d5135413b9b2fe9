#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "samples/command_line/method_options.h"
#include "samples/command_line/tracer_option.h"
#include "samples/denoise/gpu_device.h"
#include "samples/host/host_graph.h"
#include "samples/host/tracer.h"

namespace walr::host {

/// The command line of `walr-host`.
struct HostOptions {
  Tracer::Options tracer;
  MethodOptions method;
  GpuDevice::Options gpu;
  TracerChoice tracerChoice = TracerChoice::Auto;
  std::string frames;  ///< Empty: in a window the whole animation, otherwise frames 0 to 11.
  std::string size;    ///< Empty: `defaultExtent`.
  std::string view = "denoised";
  std::uint32_t resampledFrames = 0;  ///< See `Tracer::Request::resampledFrames`.
  std::string compare;                ///< Method with or without a preset, for the right side; empty: none.
  std::filesystem::path output;
  std::filesystem::path record;  ///< File of an animation; empty: none.
  std::string exposure = "auto";
  double targetMilliseconds = 0.0;  ///< See `ResolutionControl::setTarget`.
  bool headless = false;
  bool exr = false;
  bool once = false;
  bool lint = false;
  bool reloadShaders = false;  ///< Only with the CMake option WALR_RELOAD_SHADERS.
};

void addHostOptions(CLI::App& program, HostOptions& options);

/// The scene that is shown if the user names none. It comes with the program.
/// @throws UsageError if the program's files lie in other places than where they were built or unpacked
std::filesystem::path builtInScene();

/// The method of a `--compare` argument: its name, and after a colon a preset.
/// @throws UsageError naming an unknown method
MethodOptions parseCompare(const std::string& text);

/// The view of a `--view` argument: denoised, noisy, reference, split, compare, or the name of a texture of the frame.
HostView parseView(const std::string& text);

}  // namespace walr::host
