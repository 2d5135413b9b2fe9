#include "tests/integration/random_frames.h"

#include <array>

#include "tests/integration/random_arguments.h"

namespace walr::test {
namespace {

/// An image of a frame and the member that holds it.
struct Port {
  const char* name;
  const WalrImage* WalrFrame::*member;
};
constexpr std::array kPorts = {Port{"lighting", &WalrFrame::lighting},
                               Port{"depth", &WalrFrame::depth},
                               Port{"normal", &WalrFrame::normal},
                               Port{"motion", &WalrFrame::motion},
                               Port{"albedo", &WalrFrame::albedo},
                               Port{"object_id", &WalrFrame::object_id},
                               Port{"confidence", &WalrFrame::confidence},
                               Port{"second_lighting", &WalrFrame::second_lighting},
                               Port{"second_confidence", &WalrFrame::second_confidence},
                               Port{"specular_albedo", &WalrFrame::specular_albedo},
                               Port{"roughness", &WalrFrame::roughness},
                               Port{"specular_motion", &WalrFrame::specular_motion},
                               Port{"denoised", &WalrFrame::denoised},
                               Port{"second_denoised", &WalrFrame::second_denoised},
                               Port{"view", &WalrFrame::view},
                               Port{"history_length", &WalrFrame::history_length},
                               Port{"light_direction", &WalrFrame::light_direction},
                               Port{"second_history_length", &WalrFrame::second_history_length},
                               Port{"second_light_direction", &WalrFrame::second_light_direction},
                               Port{"expected_error", &WalrFrame::expected_error},
                               Port{"second_expected_error", &WalrFrame::second_expected_error}};
constexpr std::size_t kLastHolding = 13;  ///< Index of the last image that may be larger than the rectangle.

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

}  // namespace

RandomFrames::RandomFrames(Host& host) : host_(&host), timeline_(host.device) {}

RandomFrames::~RandomFrames() {
  destroyAll();
}

void RandomFrames::destroyAll() {
  for (HostImage& image : images_) host_destroy_image(host_, &image);
  for (HostBuffer& buffer : buffers_) host_destroy_buffer(host_, &buffer);
  images_.clear();
  buffers_.clear();
}

/// An image in the layout GENERAL. Its contents do not matter: no denoiser may trip over them.
HostImage& RandomFrames::makeImage(VkFormat format, std::uint32_t width, std::uint32_t height,
                                   VkImageUsageFlags usage) {
  images_.push_back(host_make_image(host_, format, width, height, usage));
  HostImage& image = images_.back();
  const VkCommandBuffer commands = host_begin(host_);
  host_transition(commands, &image, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                  VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT, VK_IMAGE_LAYOUT_GENERAL);
  host_submit_and_wait(host_, commands);
  return image;
}

WalrImage RandomFrames::describe(Dice& dice, const HostImage& image) {
  WalrImage described{.struct_size = sizeof(WalrImage),
                      .queue_family = dice.oneIn(2) ? VK_QUEUE_FAMILY_IGNORED : host_->queue_family,
                      .image = image.image,
                      .identity = dice.oneIn(4) ? 0 : ++lastIdentity_,
                      .format = image.format,
                      .usage = image.usage,
                      .width = image.width,
                      .height = image.height,
                      .acquire = {image.stage, image.access, image.layout, 0},
                      .release = {}};
  if (dice.oneIn(4)) {
    described.release = {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                         VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, 0};
  }
  return described;
}

/// A buffer of zeros: some passes read the number of their groups from one.
VkBuffer RandomFrames::makeBuffer(const WalrResource& resource) {
  buffers_.push_back(
      host_make_buffer(host_, resource.buffer_size, resource.buffer_usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, 0));
  const VkCommandBuffer commands = host_begin(host_);
  vkCmdFillBuffer(commands, buffers_.back().buffer, 0, VK_WHOLE_SIZE, 0);
  host_submit_and_wait(host_, commands);
  return buffers_.back().buffer;
}

/// @param finishedValue of the timeline semaphore; 0: it is not signalled
void RandomFrames::submit(VkCommandBuffer commands, std::uint64_t finishedValue) {
  if (finishedValue == 0) {
    host_submit_and_wait(host_, commands);
    return;
  }
  host_submit_between(host_, commands, timeline_.semaphore(), timeline_.value(), finishedValue);
  timeline_.raiseTo(finishedValue);
}

void RandomFrames::record(Dice& dice, CallCheck& check, const ModelledDenoiser& denoiser) {
  Expectation expected;
  if (denoiser.changed) expected.mayFail();
  if (denoiser.allocates) expected.mayRunOutOfMemory();
  WalrFrame frame{};
  frame.struct_size = dice.oneIn(40) ? dice.of({0U, 4U, 1U << 20}) : sizeof(frame);
  if (frame.struct_size != sizeof(frame)) expected.fails(WALR_ERROR_STRUCT_SIZE);
  frame.flags = dice.oneIn(4) ? dice.below(4) : 0U;
  if (denoiser.rectangle && dice.oneIn(2)) frame.offset[dice.below(2)] = 1 + dice.below(3);
  const std::array<std::uint32_t, 2> offset{frame.offset[0], frame.offset[1]};
  chooseFrame(dice, expected, frame);

  std::array<WalrImage, kPorts.size()> images{};
  std::array<const WalrImage*, kPorts.size()> given{};
  for (std::size_t i = 0; i < kPorts.size(); ++i) {
    WalrImageRequirements needs{};
    needs.struct_size = sizeof(needs);
    if (walr_get_image_requirements(denoiser.handle, kPorts[i].name, &needs) != WALR_SUCCESS ||
        needs.required == VK_FALSE)
      continue;
    // The host's barriers are for colour images only.
    if (needs.format >= VK_FORMAT_D16_UNORM && needs.format <= VK_FORMAT_D32_SFLOAT_S8_UINT) return destroyAll();
    const bool exact = i > kLastHolding;
    images[i] = describe(dice, makeImage(needs.format, needs.width + (exact ? 0 : offset[0]),
                                         needs.height + (exact ? 0 : offset[1]), needs.usage));
    given[i] = &images[i];
    if (!dice.oneIn(30)) continue;
    expected.fails();
    if (dice.oneIn(3)) {
      given[i] = nullptr;
    } else {
      spoil(dice, images[i]);
    }
  }
  for (std::size_t i = 0; i < kPorts.size(); ++i) frame.*kPorts[i].member = given[i];
  if (frame.lighting != nullptr && frame.denoised != nullptr && dice.oneIn(30)) {
    frame.denoised = frame.lighting;  // An input is no output.
    expected.fails();
  }
  if (denoiser.lights.size() < 2 && frame.lighting != nullptr && dice.oneIn(30)) {
    frame.second_lighting = frame.lighting;
    expected.fails();
  }
  WalrCamera camera;
  WalrCamera previous;
  frame.camera = randomCamera(dice, expected, denoiser.orthographic, camera);
  Expectation ofPrevious;
  if (dice.oneIn(3) && randomCamera(dice, ofPrevious, denoiser.orthographic, previous) != nullptr) {
    frame.previous_camera = &previous;
    if (!ofPrevious.allows(WALR_SUCCESS)) expected.fails();
  }
  expected.mayFail();  // The camera of the frame before may not fit.
  std::uint64_t finishedValue = 0;
  if (dice.oneIn(3)) {
    frame.finished = timeline_.semaphore();
    frame.finished_value = finishedValue = timeline_.value() + 1 + dice.below(3);
  } else if (dice.oneIn(16)) {
    frame.finished_value = 1;  // Of no semaphore.
    expected.fails();
  }
  const VkCommandBuffer commands = host_begin(host_);
  const bool withoutCommands = dice.oneIn(16);
  if (withoutCommands) expected.fails();
  const WalrResult result =
      check("walr_record", expected,
            {"WalrFrame", "WalrImage", "WalrCamera", "WalrMemory", "camera", "matrix", "image '", "origin", "sky_depth",
             "exposure", "offset", "command buffer", "finished", "created without", "setting", "view", "regression",
             "specular light", "svgf."},
            [&] { return walr_record(denoiser.handle, withoutCommands ? VK_NULL_HANDLE : commands, &frame); });
  recorded_ += result == WALR_SUCCESS;
  submit(commands, result == WALR_SUCCESS ? finishedValue : 0);
  for (const HostImage& image : images_) walr_forget_image(denoiser.handle, image.image, 0);
  for (const WalrImage& image : images) {
    if (image.image != VK_NULL_HANDLE) walr_forget_image(denoiser.handle, image.image, image.identity);
  }
  destroyAll();
}

WalrPassResource RandomFrames::resourceFor(Dice& dice, const WalrResource& resource) {
  if (resource.kind == WALR_RESOURCE_UPLOAD || resource.kind == WALR_RESOURCE_LIBRARY) return {};
  if (resource.kind == WALR_RESOURCE_HISTORY_PREVIOUS && dice.oneIn(2)) return {};
  if (resource.buffer == VK_TRUE) return {VK_NULL_HANDLE, makeBuffer(resource), 0, VK_IMAGE_LAYOUT_UNDEFINED, 0};
  return {makeImage(resource.format, resource.width, resource.height, resource.image_usage).image, VK_NULL_HANDLE,
          ++lastIdentity_, VK_IMAGE_LAYOUT_GENERAL, 0};
}

void RandomFrames::recordPass(Dice& dice, CallCheck& check, const ModelledPasses& passes) {
  Expectation expected;
  expected.mayFail();  // The pass may have been recorded in this frame.
  if (!passes.recordable || !passes.begun) expected.fails(WALR_ERROR_WRONG_ORDER);
  if (passes.allocates) expected.mayRunOutOfMemory();
  std::uint32_t index = dice.below(passes.list->pass_count);
  const WalrDispatch& pass = *passes.list->passes[index];
  std::vector<WalrPassResource> resources;
  for (std::uint32_t i = 0; i < pass.binding_count; ++i) {
    const WalrResource& resource = *passes.list->resources[pass.bindings[i]->resource];
    if (resource.format >= VK_FORMAT_D16_UNORM && resource.format <= VK_FORMAT_D32_SFLOAT_S8_UINT) return destroyAll();
    resources.push_back(resourceFor(dice, resource));
  }
  auto count = static_cast<std::uint32_t>(resources.size());
  const WalrPassResource* given = resources.data();
  const VkCommandBuffer commands = host_begin(host_);
  VkCommandBuffer givenCommands = commands;
  if (dice.oneIn(6)) {
    expected.fails();
    WalrPassResource& spoiled = resources[dice.below(resources.size())];
    switch (dice.below(6)) {
      case 0:
        index = passes.list->pass_count + dice.below(1000);
        break;
      case 1:
        --count;
        break;
      case 2:
        given = nullptr;
        break;
      case 3:
        givenCommands = VK_NULL_HANDLE;
        break;
      case 4:
        spoiled.layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
        if (spoiled.image == VK_NULL_HANDLE) givenCommands = VK_NULL_HANDLE;
        break;
      default:
        count = 0;
        if (resources.empty()) givenCommands = VK_NULL_HANDLE;
    }
  }
  const WalrResult result = check("walr_record_pass", expected,
                                  {"WalrPasses", "without a device", "walr_begin_frame", "command buffer",
                                   "the array of resources", "pass ", "WalrMemory"},
                                  [&] { return walr_record_pass(passes.handle, index, givenCommands, given, count); });
  recordedPasses_ += result == WALR_SUCCESS;
  host_submit_and_wait(host_, commands);
  for (const WalrPassResource& resource : resources) {
    if (resource.image != VK_NULL_HANDLE) walr_forget_pass_image(passes.handle, resource.image, resource.identity);
  }
  destroyAll();
}

}  // namespace walr::test
