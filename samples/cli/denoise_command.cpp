#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "framegraph/vulkan/instance.h"
#include "framegraph/vulkan/physical_device.h"
#include "passes/denoiser.h"
#include "samples/cli/command.h"
#include "samples/command_line/arguments.h"
#include "samples/command_line/device_options.h"
#include "samples/command_line/exit_code.h"
#include "samples/command_line/method_options.h"
#include "samples/command_line/motion_depth.h"
#include "samples/command_line/usage_error.h"
#include "samples/denoise/frame_output.h"
#include "samples/denoise/gpu_denoiser.h"
#include "samples/denoise/pipeline.h"
#include "samples/denoise/progress.h"
#include "samples/denoise/report.h"
#include "samples/image/file_output.h"
#include "samples/sequence/sequence.h"

namespace walr {
namespace {

/// The device works on one frame while the CPU records the next one and reads back the previous one.
constexpr std::uint32_t kFramesInFlight = 2;

struct DenoiseOptions {
  std::filesystem::path input;
  OutputOptions output;
  MethodOptions method;
  std::string frames;
  GpuDevice::Options gpu;
  bool listDevices = false;
  std::filesystem::path json;
  std::string nonFinite = "fail";
  std::string exposure = "auto";
  std::string directLight = "frame";
  std::vector<std::string> views;
  bool listViews = false;
  bool counters = false;
  SequenceOptions sequence;
};

void describeInput(std::ostream& stream, const std::filesystem::path& input, const Sequence& sequence) {
  const auto& entries = sequence.entries();
  const RecognizedLayout& layout = sequence.layout();
  stream << "input: " << input.string() << ", frames " << entries.front().number << " to " << entries.back().number
         << ", " << sequence.extent().width << " x " << sequence.extent().height << " pixels\n"
         << "layout: " << layout.layout->name
         << (layout.viewLayer.empty() ? "" : " (view layer '" + layout.viewLayer + "')") << ", "
         << (sequence.hasReferences() ? "with references" : "no references: no errors are measured") << '\n';
  for (std::size_t i = 1; i < entries.size(); ++i) {
    if (entries[i].resetHistory) {
      stream << "camera cut: history is reset at frame " << entries[i].number << '\n';
    }
  }
}

void noteNonFinite(Progress& progress, const Frame& frame) {
  for (const NonFiniteChannel& channel : frame.nonFinite) {
    progress.note("frame " + std::to_string(frame.number) + ": replaced " + std::to_string(channel.count) +
                  " non-finite value(s) in " + channel.channel + " of " + channel.file.filename().string());
  }
}

void refuseOutputIntoInput(const DenoiseOptions& options) {
  std::error_code ignored;
  if (std::filesystem::equivalent(options.input, options.output.directory, ignored)) {
    throw UsageError(
        "--output is the input folder; results there would count as frames of the sequence. Choose "
        "another folder.");
  }
}

/// One line for each view that the method has with its settings.
std::string viewList(const std::vector<ViewInfo>& views) {
  std::string text;
  for (const ViewInfo& view : views) {
    text.append("\n  ").append(view.name).append(": ").append(view.description);
  }
  return text;
}

void listViews(const MethodOptions& options) {
  const std::vector<ViewInfo> views = makeMethod(options)->views();
  std::cout << "method " << options.name << " has " << (views.empty() ? "no views" : "these views") << viewList(views)
            << '\n';
}

void refuseUnknownViews(const DenoiseOptions& options, Denoiser& method) {
  const std::vector<ViewInfo> views = method.views();
  for (const std::string& wanted : options.views) {
    const auto isWanted = [name = wanted.substr(0, wanted.find('.'))](const ViewInfo& view) {
      return view.name == name;
    };
    if (std::ranges::any_of(views, isWanted)) continue;
    if (wanted == "?") throw UsageError("--view ?: give --list-views to see the method's views");
    throw UsageError("--view " + wanted + ": method " + options.method.name +
                     (views.empty() ? " has no views" : " has no such view with these settings; it has") +
                     viewList(views));
  }
}

/// @returns exposure in stops; nullopt: automatic
std::optional<float> parseExposure(const std::string& text) {
  if (text == "auto") return std::nullopt;
  float stops = 0.0F;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), stops);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(stops)) {
    throw UsageError("--exposure " + text + ": give auto or a number of stops, as in --exposure 1.5");
  }
  return stops;
}

/// @throws UsageError naming a view of an iteration that does not exist at this image size, or contradictory settings
GpuDenoiser makeGpuDenoiser(const DenoiseOptions& options, const GpuDevice& device, Denoiser& method,
                            const Sequence& sequence) {
  try {
    return {device,
            method,
            sequence.extent(),
            sequence.denoiserLayout(),
            {.views = options.views, .counters = options.counters},
            kFramesInFlight,
            sequence.layout().objectIds};
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

void denoise(DenoiseOptions& options) {
  options.sequence.composite = options.output.composite;
  options.output.referenceDirect = options.directLight == "reference";
  options.output.exposure = parseExposure(options.exposure);
  options.sequence.nonFinite = options.nonFinite == "replace" ? NonFinitePolicy::Replace : NonFinitePolicy::Fail;
  if (!options.frames.empty()) {
    options.sequence.frames = parseFrameRange(options.frames);
  }
  const std::unique_ptr<Denoiser> method = makeMethod(options.method);
  refuseUnknownViews(options, *method);
  refuseOutputIntoInput(options);
  const Sequence sequence(options.input, options.sequence);
  prepareOutputDirectory(options.output.directory);
  describeInput(std::cout, options.input, sequence);

  GpuDevice device(options.gpu);
  GpuDenoiser denoiser = makeGpuDenoiser(options, device, *method, sequence);
  DenoiseReport report;
  report.method = options.method.name;
  for (const SettingText& setting : method->settings()) {
    report.settings.emplace_back(setting.name, setting.value);
  }
  report.device = device.name();
  report.driver = device.driver();
  report.softwareDevice = device.isSoftware();
  report.layout = sequence.layout().layout->name;
  report.extent = sequence.extent();
  std::cout << "method: " << report.method << "\ndevice: " << report.device << ", driver " << report.driver
            << (report.softwareDevice ? " (software)" : "") << std::endl;
  {
    FrameWriter writer(options.output);
    Progress progress(std::cerr, isatty(STDERR_FILENO) != 0, "frame", sequence.entries().size(),
                      Progress::Clock::now());
    runPipeline(
        sequence.entries().size(), [&](std::size_t index) { return packFrame(sequence.read(index)); },
        [&](PackedFrame frame) {
          std::optional<DenoisedFrame> done = denoiser.full() ? denoiser.finish() : std::nullopt;
          denoiser.submit(std::move(frame));
          return done;
        },
        [&] { return denoiser.finish(); },
        [&](const DenoisedFrame& frame) {
          writer.write(frame);
          report.frames.push_back(measure(frame));
          noteNonFinite(progress, frame.frame);
          if (const std::size_t count = report.frames.back().nonFiniteOutput; count > 0) {
            progress.note("warning: frame " + std::to_string(frame.frame.number) + ": " + std::to_string(count) +
                          " non-finite value(s) in the result");
          }
          progress.advance(Progress::Clock::now());
        });
  }
  device.refuseMessages();
  printReport(std::cout, report);
  if (!options.json.empty()) {
    const std::string text = reportJson(report);
    writeFileAtomically(options.json, std::as_bytes(std::span(text)));
  }
}

void listDevices() {
  const fg::vk::Instance instance;
  std::cout << fg::vk::listing(fg::vk::physicalDevices(instance));
}

}  // namespace

void registerDenoise(CLI::App& program) {
  const auto options = std::make_shared<DenoiseOptions>();
  CLI::App* command =
      program.add_subcommand("denoise", "Denoise a sequence of multi-layer EXR frames on a Vulkan device");
  CLI::Option* input =
      command->add_option("INPUT", options->input,
                          "Folder of frames: Blender Cycles' multi-layer EXR with cameras.json, or walr's own layout "
                          "(samples/docs/sequences.md); files whose names start with 'ref' are references");
  input->type_name("DIR");
  CLI::Option* output = command->add_option(
      "-o,--output", options->output.directory,
      "Folder for denoised_FFFF.exr: half float, Indirect.{R,G,B}, demodulated; created if missing");
  output->type_name("DIR");
  addMethodOptions(*command, options->method);
  command->add_option("--frames", options->frames, "First and last frame to denoise; default: all")->type_name("A-B");
  addDeviceOptions(*command, options->gpu);
  command->add_flag("--list-devices", options->listDevices, "List the Vulkan devices and exit");
  command
      ->add_option("--json", options->json,
                   "Write device, driver, times (ms) and errors of every frame and their means to this file")
      ->type_name("FILE");
  command
      ->add_option("--view", options->views,
                   "Also write a view of a quantity inside the method: view_NAME_FFFF.exr, channels X, Y, Z; "
                   "repeatable. NAME.T shows iteration T (0 is the first) instead of the last one")
      ->allow_extra_args(false)
      ->type_name("NAME");
  command->add_flag("--list-views", options->listViews, "List the views of the method with its settings and exit");
  command->add_flag("--counters", options->counters,
                    "Count events inside the method in every frame (non-finite values, rejected history, replaced "
                    "taps, regularised and clamped fits, and more) and print the counts; with --json, also write "
                    "them. Times then include the counting");
  command->add_flag("--composite", options->output.composite,
                    "Write the lit image, albedo * (direct + indirect) + emission, as R,G,B; needs those channels. "
                    "Errors are still those of the indirect light");
  command
      ->add_option("--direct-light", options->directLight,
                   "Direct light of lit images: from the frame, or from its reference if there is one. Engines compute "
                   "direct light by other means; without its noise, images differ in the denoised light only")
      ->check(CLI::IsMember({"frame", "reference"}))
      ->type_name("")
      ->capture_default_str();
  command->add_flag("--png", options->output.png,
                    "Also write denoised_FFFF.png and comparison_FFFF.png (noisy | denoised | reference), tone-mapped "
                    "by x/(1+x), then sRGB; with --composite the lit image, and beside or below it the light alone");
  command
      ->add_option(
          "--exposure", options->exposure,
          "Exposure of the PNGs in stops: a number, or auto, which maps the log-average luminance to middle grey "
          "(Reinhard et al. 2002) at the first frame and after each camera cut")
      ->type_name("auto|EV")
      ->capture_default_str();
  command
      ->add_option("--non-finite", options->nonFinite,
                   "Non-finite values in the input: fail, or replace them before they enter an average")
      ->check(CLI::IsMember({"fail", "replace"}))
      ->type_name("")
      ->capture_default_str();
  command
      ->add_option("--cut", options->sequence.cuts,
                   "Number of the first frame after a camera cut: history is reset there; repeatable. Cuts that follow "
                   "from the cameras are detected without it")
      ->allow_extra_args(false)
      ->type_name("N");
  addMotionDepth(*command, options->sequence);
  command->add_option("--view-layer", options->sequence.viewLayer, "View layer to read if the files hold several")
      ->type_name("NAME");
  command->footer(kExitCodeHelp);
  command->callback([=] {
    if (options->listDevices) {
      listDevices();
      return;
    }
    if (options->listViews) {
      listViews(options->method);
      return;
    }
    for (const CLI::Option* option : {input, output}) {
      if (option->empty()) {
        throw CLI::RequiredError(option->get_name());
      }
    }
    denoise(*options);
  });
}

}  // namespace walr
