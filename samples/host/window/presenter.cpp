#include "samples/host/window/presenter.h"

#include <algorithm>

#include "framegraph/vulkan/error.h"
#include "framegraph/vulkan/memory_barrier.h"

namespace walr::host {
namespace {

using fg::vk::check;

constexpr VkClearColorValue kBackground = {{0.06F, 0.06F, 0.07F, 1.0F}};
constexpr VkImageSubresourceRange kWholeImage = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};

}  // namespace

Rectangle fitPicture(fg::Extent picture, const Rectangle& area) {
  const double scale =
      std::min(static_cast<double>(area.width) / picture.width, static_cast<double>(area.height) / picture.height);
  const double whole = scale >= 1.0 ? static_cast<double>(static_cast<int>(scale)) : scale;
  Rectangle place;
  place.width = std::max(1, static_cast<int>(picture.width * whole));
  place.height = std::max(1, static_cast<int>(picture.height * whole));
  place.x = area.x + (area.width - place.width) / 2;
  place.y = area.y + (area.height - place.height) / 2;
  return place;
}

Presenter::Presenter(const GpuDevice& device, VkSurfaceKHR surface, fg::Extent window, const ShownPicture& picture,
                     std::uint32_t framesInFlight, std::function<void(VkCommandBuffer)> drawInterface)
    : device_(device),
      swapchain_(device, surface, window, framesInFlight),
      drawInterface_(std::move(drawInterface)),
      pictureExtent_(picture.desc().extent),
      graph_(declare(picture)),
      executor_(device.device().context(), graph_.desc(), compileFor(device, graph_),
                {.framesInFlight = framesInFlight}) {
  executor_.bind(picture_, picture.external());
  makeRenderPass();
  makeFramebuffers();
}

Presenter::~Presenter() {
  const VkDevice device = device_.device().context().view.device;
  for (VkFramebuffer framebuffer : framebuffers_) {
    vkDestroyFramebuffer(device, framebuffer, nullptr);
  }
  vkDestroyRenderPass(device, renderPass_, nullptr);
}

fg::Graph Presenter::declare(const ShownPicture& picture) {
  fg::Graph graph;
  picture_ = graph.import("shown picture", picture.desc(), kShown);
  // The swapchain's image is available once its semaphore is signalled, and transfers wait for that.
  window_ = graph.import("window", swapchain_.desc(),
                         {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_UNDEFINED});
  const fg::Texture source = picture_;
  fg::PassBuilder show = graph.callback(
      "show picture", [this, source](const fg::RecordContext& context) { showPicture(context, source); });
  show.access(source, fg::Access::TransferRead);
  const fg::Texture shown = show.access(window_, fg::Access::TransferWrite);
  fg::PassBuilder draw =
      graph.callback("interface", [this](const fg::RecordContext& context) { drawInterface(context.commandBuffer); });
  const fg::Texture drawn = draw.access(shown, fg::Access::ColorReadWrite);
  graph.exported(drawn, {VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR});
  return graph;
}

void Presenter::makeRenderPass() {
  VkAttachmentDescription attachment{};
  attachment.format = swapchain_.desc().format;
  attachment.samples = VK_SAMPLE_COUNT_1_BIT;
  attachment.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
  attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  attachment.initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  attachment.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &reference;
  VkRenderPassCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
  info.attachmentCount = 1;
  info.pAttachments = &attachment;
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  check(vkCreateRenderPass(device_.device().context().view.device, &info, nullptr, &renderPass_),
        "creating a render pass");
}

void Presenter::makeFramebuffers() {
  const fg::Extent extent = swapchain_.desc().extent;
  for (std::uint32_t i = 0; i < swapchain_.images().size(); ++i) {
    const VkImageView view = swapchain_.view(i);
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = renderPass_;
    info.attachmentCount = 1;
    info.pAttachments = &view;
    info.width = extent.width;
    info.height = extent.height;
    info.layers = 1;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    check(vkCreateFramebuffer(device_.device().context().view.device, &info, nullptr, &framebuffer),
          "creating a framebuffer");
    framebuffers_.push_back(framebuffer);
  }
}

void Presenter::record(const fg::vk::Frame& recorded, std::uint32_t image, const Rectangle& place, fg::Extent shown) {
  shown_ = shown;
  image_ = image;
  place_ = place;
  executor_.bind(window_, {swapchain_.images()[image], std::uint64_t{image} + 1});
  executor_.record(recorded.commandBuffer, recorded.slot);
}

void Presenter::showPicture(const fg::RecordContext& context, fg::Texture picture) {
  const VkImage window = swapchain_.images()[image_];
  vkCmdClearColorImage(context.commandBuffer, window, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &kBackground, 1,
                       &kWholeImage);
  constexpr fg::ExternalState kTransferWrite{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
  fg::vk::recordMemoryBarrier(device_.device().context(), context.commandBuffer, kTransferWrite, kTransferWrite);

  const fg::Extent extent = swapchain_.desc().extent;
  const bool inside = place_.x >= 0 && place_.y >= 0 && place_.x + place_.width <= static_cast<int>(extent.width) &&
                      place_.y + place_.height <= static_cast<int>(extent.height);
  if (!inside) {
    return;  // The window is too small to show anything.
  }
  VkImageBlit region{};
  region.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.srcOffsets[1] = {static_cast<int>(shown_.width), static_cast<int>(shown_.height), 1};
  region.dstSubresource = region.srcSubresource;
  region.dstOffsets[0] = {place_.x, place_.y, 0};
  region.dstOffsets[1] = {place_.x + place_.width, place_.y + place_.height, 1};
  // Of a picture in its full size, each pixel becomes a square of pixels.
  const bool squares = shown_ == pictureExtent_ && place_.width >= static_cast<int>(pictureExtent_.width);
  vkCmdBlitImage(context.commandBuffer, context.image(picture), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, window,
                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region, squares ? VK_FILTER_NEAREST : VK_FILTER_LINEAR);
}

void Presenter::drawInterface(VkCommandBuffer commandBuffer) const {
  const fg::Extent extent = swapchain_.desc().extent;
  VkRenderPassBeginInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
  info.renderPass = renderPass_;
  info.framebuffer = framebuffers_[image_];
  info.renderArea.extent = {extent.width, extent.height};
  vkCmdBeginRenderPass(commandBuffer, &info, VK_SUBPASS_CONTENTS_INLINE);
  drawInterface_(commandBuffer);
  vkCmdEndRenderPass(commandBuffer);
}

}  // namespace walr::host
