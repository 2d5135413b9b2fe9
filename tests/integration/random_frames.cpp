#include "tests/integration/random_frames.h"

#include <array>
#include <limits>

#include "tests/integration/random_arguments.h"

namespace walr::test {
namespace {

constexpr std::array<const char*, 9> kPorts = {"lighting",  "depth",      "normal",   "motion",        "albedo",
                                               "object_id", "confidence", "denoised", "history_length"};
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Makes one of the image's members wrong.
void spoil(Dice& dice, WalrImage& image) {
  switch (dice.below(7)) {
    case 0:
      image.struct_size = dice.of({0U, 4U, 1U << 20});
      break;
    case 1:
      image.image = VK_NULL_HANDLE;
      break;
    case 2:
      image.format = VK_FORMAT_R8G8_SNORM;
      break;
    case 3:
      image.width = 0;
      break;
    case 4:
      image.usage = 0;
      break;
    case 5:
      image.queue_family = 77;
      break;
    default:
      image.release.layout = VK_IMAGE_LAYOUT_PREINITIALIZED;
  }
}

/// Makes one of the frame's members wrong.
void spoil(Dice& dice, WalrFrame& frame) {
  switch (dice.below(8)) {
    case 0:
      frame.struct_size = dice.of({0U, 4U, 1U << 20});
      break;
    case 1:
      frame.flags = 0x80;
      break;
    case 2:
      frame.camera = nullptr;
      break;
    case 3:
      frame.sky_depth = kNan;
      break;
    case 4:
      frame.pre_exposure = -1.0F;
      break;
    case 5:
      frame.finished_value = 1;
      break;
    case 6:
      frame.origin[1] = kNan;
      break;
    default:
      frame.offset[0] = 20'000;
  }
}

}  // namespace

RandomFrames::~RandomFrames() {
  for (HostImage& image : images_) host_destroy_image(host_, &image);
}

/// An image in the layout GENERAL. Its contents do not matter: no denoiser may trip over them.
WalrImage RandomFrames::makeImage(const WalrImageRequirements& needs) {
  images_.push_back(host_make_image(host_, needs.format, needs.width, needs.height, needs.usage));
  HostImage& image = images_.back();
  VkCommandBuffer commands = host_begin(host_);
  host_transition(commands, &image, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT,
                  VK_IMAGE_LAYOUT_GENERAL);
  host_submit_and_wait(host_, commands);
  return {.struct_size = sizeof(WalrImage),
          .queue_family = VK_QUEUE_FAMILY_IGNORED,
          .image = image.image,
          .identity = ++lastIdentity_,
          .format = image.format,
          .usage = image.usage,
          .width = image.width,
          .height = image.height,
          .acquire = {image.stage, image.access, image.layout, 0},
          .release = {}};
}

void RandomFrames::record(Dice& dice, CallCheck& check, const ModelledDenoiser& denoiser) {
  Expectation expected;
  if (denoiser.changed) expected.mayFail();
  std::array<WalrImage, kPorts.size()> images{};
  std::array<const WalrImage*, kPorts.size()> given{};
  for (std::size_t i = 0; i < kPorts.size(); ++i) {
    WalrImageRequirements needs{};
    needs.struct_size = sizeof(needs);
    if (walr_get_image_requirements(denoiser.handle, kPorts[i], &needs) != WALR_SUCCESS || needs.required == VK_FALSE)
      continue;
    // The host's barriers are for colour images only.
    if (needs.format >= VK_FORMAT_D16_UNORM && needs.format <= VK_FORMAT_D32_SFLOAT_S8_UINT) return;
    images[i] = makeImage(needs);
    given[i] = &images[i];
    if (!dice.oneIn(30)) continue;
    expected.fails();
    if (dice.oneIn(3)) {
      given[i] = nullptr;
    } else {
      spoil(dice, images[i]);
    }
  }
  WalrCamera camera;
  WalrFrame frame{};
  frame.struct_size = sizeof(frame);
  frame.lighting = given[0];
  frame.depth = given[1];
  frame.normal = given[2];
  frame.motion = given[3];
  frame.albedo = given[4];
  frame.object_id = given[5];
  frame.confidence = given[6];
  frame.denoised = given[7];
  frame.history_length = given[8];
  frame.camera = randomCamera(dice, expected, camera);
  frame.flags = dice.oneIn(6) ? static_cast<std::uint32_t>(WALR_FRAME_RESET_HISTORY) : 0U;
  expected.mayFail();  // The camera of the frame before may not fit.
  if (dice.oneIn(8)) {
    spoil(dice, frame);
    expected.fails();
  }
  const VkCommandBuffer commands = host_begin(host_);
  const bool withoutCommands = dice.oneIn(16);
  if (withoutCommands) expected.fails();
  const WalrResult result =
      check("walr_record", expected,
            {"WalrFrame", "WalrImage", "WalrCamera", "camera", "matrix", "image '", "origin", "sky_depth", "exposure",
             "offset", "command buffer", "finished_value", "setting", "regression", "svgf."},
            [&] { return walr_record(denoiser.handle, withoutCommands ? VK_NULL_HANDLE : commands, &frame); });
  recorded_ += result == WALR_SUCCESS;
  host_submit_and_wait(host_, commands);
  for (const WalrImage& image : images) {
    if (image.image != VK_NULL_HANDLE) walr_forget_image(denoiser.handle, image.image, image.identity);
  }
}

}  // namespace walr::test
