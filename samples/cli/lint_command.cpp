#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "samples/cli/command.h"
#include "samples/command_line/arguments.h"
#include "samples/command_line/channel_options.h"
#include "samples/command_line/choice.h"
#include "samples/command_line/device_options.h"
#include "samples/command_line/exit_code.h"
#include "samples/command_line/motion_depth.h"
#include "samples/denoise/gpu_linter.h"
#include "samples/errors.h"
#include "samples/sequence/sequence.h"

namespace walr {
namespace {

struct LintOptions {
  std::filesystem::path input;
  std::string frames;
  Light light = Light::Indirect;
  GpuDevice::Options gpu;
  SequenceOptions sequence;
};

std::string describe(const std::vector<NonFiniteChannel>& channels, const std::string& where) {
  const NonFiniteChannel& first = channels.front();
  return first.file.string() + ": channel " + first.channel + " is NaN or infinite on " + std::to_string(first.count) +
         " pixels " + where + ", the first at (" + std::to_string(first.firstX) + ", " + std::to_string(first.firstY) +
         "); " + std::to_string(channels.size()) + " channels of all frames have such pixels";
}

void lint(LintOptions& options) {
  if (!options.frames.empty()) options.sequence.frames = parseFrameRange(options.frames);
  options.sequence.nonFinite = NonFinitePolicy::Replace;
  const bool direct = options.light == Light::Direct;
  options.sequence.light = {.indirect = !direct, .direct = direct, .specular = SpecularWish::IfHeld};
  const Sequence sequence(options.input, options.sequence);
  GpuDevice device(options.gpu);
  GpuLinter linter(device, sequence.extent(), sequence.denoiserLayout());
  std::vector<NonFiniteChannel> ofFrames, ofReferences;
  for (std::size_t i = 0; i < sequence.entries().size(); ++i) {
    Frame frame = sequence.read(i);
    if (direct) frame.indirect = std::move(frame.direct);
    for (const NonFiniteChannel& channel : frame.nonFinite) {
      (channel.file == sequence.entries()[i].reference ? ofReferences : ofFrames).push_back(channel);
    }
    linter.add(frame);
  }
  device.refuseMessages();
  std::vector<LintFinding> findings = linter.findings();
  for (LintFinding& finding : findings) {
    if (finding.name != "lighting-negative" || !sequence.lossy()) continue;
    finding.cause = "the lossy compression of the files (B44 or DWA), which moves dark values below 0";
    finding.wayOut = "save frames with a lossless compression, such as ZIP or PIZ";
  }
  // Without a surface, the linter takes such values for sky.
  const auto namesThem = [](const LintFinding& finding) { return finding.name.ends_with("-not-finite"); };
  if (!ofFrames.empty() && std::ranges::none_of(findings, namesThem)) {
    findings.push_back({"sky-not-finite", describe(ofFrames, "of the sky"),
                        "rays that hit nothing got no finite depth, or other values that were not set",
                        "write a depth of 1e10 and zeros there, or give walr denoise --non-finite replace"});
  }
  if (!ofReferences.empty()) {
    findings.push_back(
        {"reference-not-finite", describe(ofReferences, "of a reference"),
         "a path with a division by zero, which spoils the mean of all samples of its pixel",
         "write NaN in all channels of a pixel that no error may count, or give walr denoise --non-finite "
         "replace, which leaves such pixels out"});
  }
  for (const LintFinding& finding : findings) std::cout << finding.text() << '\n';
  std::cout.flush();
  if (!findings.empty()) {
    throw InputError(options.input.string() + ": " + std::to_string(findings.size()) +
                     (findings.size() == 1 ? " thing looks" : " things look") + " wrong");
  }
  std::cout << sequence.entries().size() << " frames, nothing looks wrong\n";
}

}  // namespace

void registerLint(CLI::App& program) {
  const auto options = std::make_shared<LintOptions>();
  CLI::App* command = program.add_subcommand(
      "lint",
      "Check the frames of a sequence for likely errors in values, normals, depth, motion and jitter, "
      "and for albedo left in the lighting; exit code 3 if something looks wrong");
  command->add_option("INPUT", options->input, "Folder of frames, as for walr denoise")->required()->type_name("DIR");
  command->add_option("--frames", options->frames, "First and last frame to check; default: all")->type_name("A-B");
  addChoice<Light, Light>(*command, "--light", options->light,
                          {{"indirect", Light::Indirect}, {"direct", Light::Direct}}, "indirect",
                          "Part of diffuse light to check");
  addDeviceOptions(*command, options->gpu);
  addMotionDepth(*command, options->sequence);
  addChannelOptions(*command, options->sequence);
  command->footer(kExitCodeHelp);
  command->callback([options] { lint(*options); });
}

}  // namespace walr
