#include <unistd.h>

#include <algorithm>
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
#include "passes/methods/denoiser.h"
#include "samples/cli/command.h"
#include "samples/command_line/arguments.h"
#include "samples/command_line/channel_options.h"
#include "samples/command_line/device_options.h"
#include "samples/command_line/exit_code.h"
#include "samples/command_line/light_rate.h"
#include "samples/command_line/method_options.h"
#include "samples/command_line/motion_depth.h"
#include "samples/command_line/usage_error.h"
#include "samples/denoise/averaged_frame.h"
#include "samples/denoise/frame_output.h"
#include "samples/denoise/light_denoisers.h"
#include "samples/denoise/pipeline.h"
#include "samples/denoise/progress.h"
#include "samples/denoise/report.h"
#include "samples/errors.h"
#include "samples/image/file_output.h"
#include "samples/sequence/sequence.h"

namespace walr {
namespace {

/// The device works on one frame while the CPU records the next one and reads back the previous one.
constexpr std::uint32_t kFramesInFlight = 2;

struct DenoiseOptions {
  std::filesystem::path input;
  OutputOptions output;
  int average = 1;  ///< Pixels of a frame along each axis for one of its pictures.
  MethodOptions method;
  std::string frames;
  GpuDevice::Options gpu;
  bool listDevices = false;
  std::filesystem::path json;
  std::string nonFinite = "fail";
  std::string exposure = "auto";
  std::string light;  ///< Empty: see `chosenLight`.
  std::string directLight = "frame";
  std::vector<std::string> views;
  bool listViews = false;
  bool counters = false;
  bool lightDirection = false;
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
  if (const LightPattern& light = sequence.denoiserLayout().conventions.light; !light.everyPixel()) {
    stream << "sparse light: one sample in " << light.columns << " x " << light.rows << " pixels\n";
  }
  if (const std::string assumption = sequence.assumption(); !assumption.empty()) stream << assumption << '\n';
  if (sequence.place() != sequence.displayWindow()) {
    const PixelRect& place = sequence.place();
    const glm::ivec2 corner = place.corner - sequence.displayWindow().corner;
    stream << "data windows: within " << place.size.x << " x " << place.size.y << " pixels from (" << corner.x << ", "
           << corner.y << ") of the picture of " << sequence.displayWindow().size.x << " x "
           << sequence.displayWindow().size.y << "\n";
  }
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

/// The lights that a value of --light names.
std::vector<Light> lightsOf(const std::string& light) {
  std::vector<Light> lights;
  if (light == "specular") return {Light::Specular};
  if (light == "all") return {Light::Indirect, Light::Direct, Light::Specular};
  if (light != "direct") lights.push_back(Light::Indirect);
  if (light != "indirect") lights.push_back(Light::Direct);
  return lights;
}

LightKinds kindsOf(std::span<const Light> lights) {
  const auto isSpecular = [](Light light) { return light == Light::Specular; };
  return {.diffuse = !std::ranges::all_of(lights, isSpecular), .specular = std::ranges::any_of(lights, isSpecular)};
}

/// @throws UsageError if the method does not take a light
std::vector<ViewInfo> viewsOf(const DenoiseOptions& options, Denoiser& method) {
  try {
    if (options.light == "all") (void)method.views({.specular = true});
    return method.views({.specular = options.light == "specular"});
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

void listViews(const DenoiseOptions& options) {
  const LightKinds lights = kindsOf(lightsOf(options.light.empty() ? "indirect" : options.light));
  const std::vector<ViewInfo> views = viewsOf(options, *makeMethod(options.method, lights));
  std::cout << "method " << options.method.name << " has " << (views.empty() ? "no views" : "these views")
            << viewList(views) << '\n';
}

void checkViews(const DenoiseOptions& options, Denoiser& method) {
  const std::vector<ViewInfo> views = viewsOf(options, method);
  for (const std::string& wanted : options.views) {
    if (std::ranges::count(options.views, wanted) > 1) throw UsageError("--view " + wanted + ": give each view once");
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

/// @throws UsageError naming an option that specular light does not have
void refuseWithSpecularLight(const DenoiseOptions& options) {
  const auto refuse = [&](const std::string& option) {
    throw UsageError("--light " + options.light + " cannot have " + option + ": leave out one of them");
  };
  if (options.average > 1) refuse("--average");
  if (!options.sequence.keptLight.everyPixel()) refuse("--light-rate");
  if (options.light == "all") return;
  if (options.output.composite) {
    throw UsageError("--composite makes whole pictures: give --light all, which denoises diffuse light, too");
  }
  if (options.directLight == "reference") refuse("--direct-light reference");
  if (options.lightDirection) refuse("--light-direction");
}

/// The value of --light, or its default.
std::string chosenLight(const DenoiseOptions& options) {
  if (options.light == "specular" || options.light == "all") refuseWithSpecularLight(options);
  const bool directIsReference = options.directLight == "reference";
  if (directIsReference && !options.output.composite) {
    throw UsageError("--direct-light reference is of lit images: give --composite, too");
  }
  if (options.light.empty()) return options.output.composite && !directIsReference ? "both" : "indirect";
  if (directIsReference && options.light != "indirect") {
    throw UsageError("--direct-light reference takes the direct light of lit images from the reference, and --light " +
                     options.light + " denoises that of the frames: leave out one of them");
  }
  return options.light;
}

/// The methods of the lights, with their settings.
std::vector<LightMethod> methodsOf(const MethodOptions& options, std::span<const Light> lights) {
  std::vector<LightMethod> methods;
  for (const Light light : lights) methods.push_back({light, makeMethod(options, kindsOf(lights))});
  return methods;
}

SettingsText settingsOf(Denoiser& method) {
  SettingsText settings;
  for (const SettingText& setting : method.settings()) settings.emplace_back(setting.name, setting.value);
  return settings;
}

/// What must be read to denoise these lights and to write what was asked for.
LightWish lightsToRead(const OutputOptions& output, std::span<const Light> denoised) {
  const auto isDenoised = [&](Light light) { return std::ranges::find(denoised, light) != denoised.end(); };
  LightWish wish{.indirect = isDenoised(Light::Indirect), .direct = isDenoised(Light::Direct)};
  if (output.composite) wish = kWholePicture;
  if (isDenoised(Light::Specular)) wish.specular = SpecularWish::Denoised;
  return wish;
}

/// Says once what a composite consists of beside the denoised lights.
void describeComposite(std::ostream& stream, const RecognizedLayout& layout, std::vector<Light> denoised,
                       bool referenceDirect) {
  if (referenceDirect) {
    stream << "composite: direct light is that of the reference, where there is one\n";
    denoised.push_back(Light::Direct);
  }
  stream << "composite: added as they are, without denoising: " << describeUndenoised(layout, denoised) << '\n';
  const std::string missing = describeMissing(layout);
  if (!missing.empty()) stream << "composite: the frames have no " << missing << '\n';
}

/// @throws UsageError naming a view of an iteration that does not exist at this image size, or contradictory settings
LightDenoisers makeDenoisers(const DenoiseOptions& options, const GpuDevice& device,
                             std::span<const LightMethod> lights, const Sequence& sequence) {
  try {
    return {device,
            lights,
            sequence.extent(),
            sequence.denoiserLayout(),
            {.views = options.views, .counters = options.counters, .lightDirection = options.lightDirection},
            kFramesInFlight,
            optionalImages(sequence.layout())};
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

/// @throws InputError if a composite would add light that only some pixels have
void refuseHoles(const DenoiseOptions& options, std::span<const Light> denoised, const Sequence& sequence) {
  const bool added = options.output.composite && std::ranges::find(denoised, Light::Indirect) == denoised.end();
  if (!added || sequence.denoiserLayout().conventions.light.everyPixel()) return;
  throw InputError(
      "--composite: indirect light has samples at some pixels only, and --light " + options.light +
      " does not denoise it, so that the pictures would have holes. Give --light both, or leave out --composite.");
}

/// The report of a run, without frames.
DenoiseReport newReport(const DenoiseOptions& options, const std::string& light, std::span<const LightMethod> methods,
                        const GpuDevice& device, const Sequence& sequence) {
  DenoiseReport report;
  report.method = options.method.name;
  report.settings = settingsOf(*methods.front().method);
  if (methods.size() > 1) report.directSettings = settingsOf(*methods[1].method);
  report.device = device.name();
  report.driver = device.driver();
  report.softwareDevice = device.isSoftware();
  report.layout = sequence.layout().layout->name;
  report.light = light;
  report.extent = sequence.extent();
  report.average = options.average;
  return report;
}

/// @throws UsageError if --average does not fit the frames
fg::Extent extentOfPictures(int average, const Sequence& sequence) {
  if (average > 1 && !ImagePlace{sequence.place(), sequence.place(), sequence.displayWindow()}.plain()) {
    throw UsageError(
        "--average: the frames are a part of the picture or reach beyond it (data window and display "
        "window differ). Render whole pictures, or leave out --average.");
  }
  try {
    return averagedExtent(sequence.extent(), average);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--average: ") + error.what());
  }
}

void denoise(DenoiseOptions& options) {
  const std::string light = chosenLight(options);
  const std::vector<Light> lights = lightsOf(light);
  options.sequence.light = lightsToRead(options.output, lights);
  options.sequence.keepSomeDirect = std::ranges::find(lights, Light::Direct) != lights.end();
  options.output.referenceDirect = options.directLight == "reference";
  options.output.exposure = parseExposure(options.exposure);
  options.sequence.nonFinite = options.nonFinite == "replace" ? NonFinitePolicy::Replace : NonFinitePolicy::Fail;
  if (!options.frames.empty()) {
    options.sequence.frames = parseFrameRange(options.frames);
  }
  const std::vector<LightMethod> methods = methodsOf(options.method, lights);
  checkViews(options, *methods.front().method);
  refuseOutputIntoInput(options);
  const Sequence sequence(options.input, options.sequence);
  const fg::Extent pictures = extentOfPictures(options.average, sequence);
  checkCameras(sequence);
  refuseHoles(options, lights, sequence);
  prepareOutputDirectory(options.output.directory);
  if (!options.json.empty()) prepareOutputFile(options.json);
  describeInput(std::cout, options.input, sequence);
  if (options.average > 1) {
    std::cout << "pictures: " << pictures.width << " x " << pictures.height << ", means over " << options.average
              << " x " << options.average << " pixels\n";
  }
  if (options.output.composite) {
    describeComposite(std::cout, sequence.layout(), lights, options.output.referenceDirect);
    options.output.indirectPlane = sequence.layout().plane(Light::Indirect);
    options.output.directPlane = sequence.layout().plane(Light::Direct);
  }

  GpuDevice device(options.gpu);
  LightDenoisers denoiser = makeDenoisers(options, device, methods, sequence);
  DenoiseReport report = newReport(options, light, methods, device, sequence);
  std::cout << "method: " << report.method << ", light: " << light << "\ndevice: " << report.device << ", driver "
            << report.driver << (report.softwareDevice ? " (software)" : "") << std::endl;
  {
    FrameWriter writer(options.output);
    Progress progress(std::cerr, isatty(STDERR_FILENO) != 0, "frame", sequence.entries().size(),
                      Progress::Clock::now());
    runPipeline(
        sequence.entries().size(), [&](std::size_t index) { return denoiser.pack(sequence.read(index)); },
        [&](PackedLights frame) {
          std::optional<DenoisedFrame> done = denoiser.full() ? denoiser.finish() : std::nullopt;
          denoiser.submit(std::move(frame));
          return done;
        },
        [&] { return denoiser.finish(); },
        [&](const DenoisedFrame& frame) {
          const auto output = [&](const DenoisedFrame& shown) {
            writer.write(frame, shown);
            report.frames.push_back(measure(frame, shown));
          };
          if (options.average > 1) {
            output(averagedLights(frame, options.average));
          } else {
            output(frame);
          }
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
    writeFileAtomically(options.json, text);
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
  CLI::Option* output = command->add_option("-o,--output", options->output.directory,
                                            "Folder for denoised_FFFF.exr: half float, Indirect.{R,G,B}, "
                                            "Direct.{R,G,B} or Specular.{R,G,B}, demodulated; created if missing");
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
  command->add_flag("--light-direction", options->lightDirection,
                    "Also write how the light changes with the normal, view space: direction_FFFF.exr, half float, "
                    "SlopeX.{R,G,B} to SlopeZ.{R,G,B}; method walr. Of the indirect light, if it is denoised");
  command
      ->add_option("--light", options->light,
                   "Light to denoise: the indirect or the direct part of diffuse light, or both, each by itself; or "
                   "specular light, or all of it. Default: indirect, and both with --composite. Views and counters are "
                   "those of the indirect light, if it is denoised")
      ->check(CLI::IsMember({"indirect", "direct", "both", "specular", "all"}))
      ->option_text("indirect|direct|both|specular|all");
  command->add_flag("--composite", options->output.composite,
                    "Also write the lit image as R,G,B: albedo * (direct + indirect), emission, and the light that is "
                    "not diffuse, as it is; but with --light all, specular light is denoised. The denoised lights then "
                    "have the names that they have in the frames, which "
                    "Blender's compositor knows");
  command
      ->add_option("--average", options->average,
                   "For frames with several primary hits per pixel of the picture: writes pictures whose pixels are "
                   "means over N x N pixels of the frames, and measures their errors")
      ->check(CLI::Range(1, kMostAveraged))
      ->type_name("N")
      ->capture_default_str();
  command
      ->add_option("--direct-light", options->directLight,
                   "Direct light of lit images: that of the frame (denoised if --light says so), or not denoised and "
                   "from the reference if there is one, so that images differ in the denoised indirect light only")
      ->check(CLI::IsMember({"frame", "reference"}))
      ->type_name("")
      ->capture_default_str();
  CLI::Option* const png = command->add_flag(
      "--png", options->output.png,
      "Also write denoised_FFFF.png and comparison_FFFF.png (noisy | denoised | reference), tone-mapped "
      "by x/(1+x), then sRGB; with --composite the lit image, and beside or below it each light alone");
  command
      ->add_option(
          "--exposure", options->exposure,
          "With --png, its exposure in stops: a number, or auto, which maps the log-average luminance to middle grey "
          "(Reinhard et al. 2002) at the first frame and after each camera cut")
      ->needs(png)
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
  addLightRate(*command, options->sequence.keptLight, kKeptLightHelp);
  addChannelOptions(*command, options->sequence);
  command->footer(kExitCodeHelp);
  command->callback([=] {
    if (options->listDevices) {
      listDevices();
      return;
    }
    if (options->listViews) {
      listViews(*options);
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
