#include "samples/command_line/resampled_frames.h"

#include "samples/command_line/usage_error.h"

namespace walr {

void addResampledFrames(CLI::App& command, std::uint32_t& frames) {
  command
      .add_option("--resampled-frames", frames,
                  "Resample the indirect light of noisy frames from as many earlier frames, as in ReSTIR GI without "
                  "spatial reuse (Ouyang et al. 2021); engines take 20 to 30; 0: plain paths")
      ->check(CLI::Range(0U, kMostResampledFrames))
      ->capture_default_str();
}

void checkResampledFrames(std::uint32_t frames, const LightPattern& light, bool specular, bool onDevice) {
  if (frames == 0) return;
  if (!light.everyPixel()) {
    throw UsageError("--light-rate and --resampled-frames: only light at every pixel can be resampled");
  }
  if (specular) {
    throw UsageError("--specular and --resampled-frames: only diffuse light can be resampled; leave out one of them");
  }
  if (onDevice) throw UsageError("--resampled-frames: the path tracer on the GPU does not resample: use --tracer cpu");
}

}  // namespace walr
