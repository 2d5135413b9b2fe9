#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <walr/walr_passes.h>

#include "framegraph/vulkan/frame_queue.h"
#include "framegraph/vulkan/staged_image.h"
#include "passes/conventions/frame.h"
#include "tests/passes/reference/frame.h"
#include "tests/vulkan/test_device.h"

namespace walr::test {

/// Runs a denoiser through the C API, frame by frame, with several frames in flight.
///
/// It shares pipelines with all runs on its device whose options do not ask for something else, because creating them
/// takes most of the time.
class HostedRun {
 public:
  struct Options {
    WalrConventions conventions{};
    std::array<VkFormat, 5> formats{};  ///< As in WalrDenoiserInfo, in the order of its members.
    VkFormat denoisedFormat = VK_FORMAT_UNDEFINED;
    bool rememberedCamera = false;  ///< Let the library remember the previous camera.
    bool lint = false;
    bool counters = false;
    bool timestamps = false;
    bool objectIds = false;                           ///< Give an image "object_id".
    VkFormat confidenceFormat = VK_FORMAT_UNDEFINED;  ///< Give an image "confidence".
    bool historyLength = false;
    bool specularMotion = false;  ///< Give an image "specular_motion", with `HostFrame::specularMotion`.
    bool specular = false;  ///< The light is specular: "albedo" is that of its lobe, and there is an image "roughness".
    std::uint32_t framesInFlight = 2;
    std::uint32_t hostSlots = 0;  ///< Frames that the host itself has in flight; 0 means `framesInFlight`.
    glm::ivec2 offset{0};         ///< Of the rectangle in images that are larger by `margin`.
    glm::ivec2 margin{0};
    WalrLog log = nullptr;
    void* logUser = nullptr;
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;  ///< Instead of the device's.
    VkPipelineCache pipelineCache = VK_NULL_HANDLE;
    const WalrMemoryCallbacks* deviceMemory = nullptr;
    const VkDeviceCreateInfo* createInfo = nullptr;
    WalrDenoiser sharedWith = nullptr;
    bool alone = false;  ///< Share nothing.
    /// Whose depth, normal, motion and albedo to use, in frames that are recorded after its own; must outlive this.
    const HostedRun* guidesOf = nullptr;
  };

  HostedRun(const fg::test::TestDevice& device, const char* method, glm::ivec2 size)
      : HostedRun(device, method, size, {}) {}
  HostedRun(const fg::test::TestDevice& device, const char* method, glm::ivec2 size, const Options& options);
  ~HostedRun();
  HostedRun(const HostedRun&) = delete;
  HostedRun& operator=(const HostedRun&) = delete;

  [[nodiscard]] WalrDenoiser denoiser() const { return denoiser_; }
  /// Change the size: create new images and forget the views of the old ones.
  void resize(glm::ivec2 size);
  /// Choose the view that the next frames write, or none for null.
  void chooseView(const char* name);
  /// Texels of the view of the frame returned last.
  [[nodiscard]] std::vector<glm::vec4> view() const;
  /// History lengths of the frame returned last, halves.
  [[nodiscard]] std::vector<std::uint16_t> historyLength() const;
  /// Change the rectangle that is denoised and keep the images.
  void moveRectangle(glm::ivec2 size, glm::ivec2 offset);
  /// Size of the images.
  [[nodiscard]] glm::ivec2 imageSize() const { return glm::ivec2(needs_[0].width, needs_[0].height); }
  /// Upload texels of an image ("lighting", ...) in its format.
  void fill(const std::string& image, std::vector<std::byte> texels);
  /// Upload all images of a frame in the usual formats, without object ids.
  void fill(const reference::HostFrame& frame);
  /// Record and submit a frame with the texels uploaded last, and return the result's texels, four halves each.
  std::vector<std::uint16_t> frame(const FrameDescription& camera, std::uint32_t flags = 0, float preExposure = 0.0F);
  /// The same with the bytes of the result.
  std::vector<std::byte> frameBytes(const FrameDescription& camera, std::uint32_t flags = 0, float preExposure = 0.0F);
  /// The same without waiting for it.
  /// @param semaphores the library is told of `finished`
  /// @returns the frame's slot
  std::uint32_t submit(const FrameDescription& camera, std::uint32_t flags = 0, float preExposure = 0.0F,
                       const fg::vk::FrameSemaphores& semaphores = {});
  /// The same into a command buffer that the caller submits.
  void record(const fg::vk::Frame& frame, const FrameDescription& camera, std::uint32_t flags = 0,
              float preExposure = 0.0F, const fg::vk::TimelinePoint& finished = {});
  /// The result's bytes of the frame that was recorded last with a slot, and that the GPU has finished.
  [[nodiscard]] std::vector<std::byte> resultOf(std::uint32_t slot) const;

 private:
  /// An image beside the result that the denoiser writes.
  struct FurtherOutput {
    WalrImageRequirements needs{};
    std::unique_ptr<fg::vk::StagedImage> image;
    std::uint64_t identity = 0;
  };

  void makeImages(glm::ivec2 size);
  [[nodiscard]] WalrImage describe(std::size_t index) const;
  [[nodiscard]] FurtherOutput makeOutput(const char* name);
  [[nodiscard]] WalrImage describe(const FurtherOutput& output) const;
  void forget(std::optional<FurtherOutput>& output);
  [[nodiscard]] bool isGiven(std::size_t index) const;
  /// Whether the image is another one's guide.
  [[nodiscard]] bool isBorrowed(std::size_t index) const;
  [[nodiscard]] fg::vk::StagedImage& output() const { return *images_.back(); }

  const fg::test::TestDevice* device_;
  std::uint32_t hostSlots_;
  bool rememberedCamera_;
  bool objectIds_;
  bool confidence_;
  bool hasHistoryLength_;
  bool specular_;
  bool specularMotion_;
  const HostedRun* guidesOf_;
  glm::ivec2 offset_;
  glm::ivec2 margin_;
  WalrDenoiser denoiser_ = nullptr;
  std::vector<WalrImageRequirements> needs_;
  std::vector<std::unique_ptr<fg::vk::StagedImage>> images_;  ///< Null for images that this does not own.
  std::array<std::vector<std::byte>, 9> texels_;
  std::optional<FurtherOutput> view_;
  std::optional<FurtherOutput> historyLength_;
  std::uint32_t lastSlot_ = 0;
  fg::vk::FrameQueue queue_;
  std::uint64_t nextIdentity_ = 1;
  std::uint64_t firstIdentity_ = 1;
};

/// The bytes of texels.
template <typename Texel>
std::vector<std::byte> texelBytes(const std::vector<Texel>& texels) {
  std::vector<std::byte> bytes(texels.size() * sizeof(Texel));
  std::memcpy(bytes.data(), texels.data(), bytes.size());
  return bytes;
}

/// The bytes of an image with a smaller one copied into it.
template <typename Texel>
std::vector<std::byte> placed(const std::vector<Texel>& picture, glm::ivec2 size, glm::ivec2 imageSize,
                              glm::ivec2 offset, Texel around) {
  std::vector<Texel> image(std::size_t(imageSize.x) * std::size_t(imageSize.y), around);
  for (int y = 0; y < size.y; ++y) {
    std::copy_n(picture.begin() + std::ptrdiff_t(y) * size.x, size.x,
                image.begin() + std::ptrdiff_t(y + offset.y) * imageSize.x + offset.x);
  }
  return texelBytes(image);
}

/// Throws std::runtime_error with the library's text if a call fails.
void require(WalrResult result);

/// A device for the C API.
WalrDevice hostDevice(const fg::vk::Device& device);

/// A denoiser for the C API. A null device suffices to list passes.
WalrDenoiserInfo denoiserInfo(const WalrDevice* device, glm::ivec2 size = {64, 48});

/// Call walr_create_passes without settings or ports.
WalrResult createPasses(const WalrDenoiserInfo& info, WalrPasses& passes);

/// The camera of a frame for the C API.
WalrCamera cameraOf(const glm::mat4& view, const glm::mat4& projection, glm::vec2 jitter);

/// Let history count in full although light without noise changes, for tests that tell its length by such a change.
/// Antilag stays on, because its passes are part of the method.
void ignoreChangesOfLight(WalrDenoiser denoiser);

/// What a function such as `walr_get_views` lists.
template <typename Item>
std::vector<Item> listed(WalrResult (*get)(WalrDenoiser, std::uint32_t*, Item*), WalrDenoiser denoiser) {
  std::uint32_t count = 0;
  require(get(denoiser, &count, nullptr));
  std::vector<Item> items(count);
  require(get(denoiser, &count, items.data()));
  return items;
}

/// Names of what the linter has found.
std::vector<std::string> findingsOf(WalrDenoiser denoiser);

}  // namespace walr::test
