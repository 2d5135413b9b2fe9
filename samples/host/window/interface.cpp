#include "samples/host/window/interface.h"

#include <algorithm>
#include <array>

#define GLFW_INCLUDE_VULKAN
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

#include "framegraph/vulkan/error.h"
#include "samples/host/window/panels.h"

namespace walr::host {
namespace {

void checkInterface(VkResult result) {
  fg::vk::check(result, "drawing the interface");
}

/// Passes the render pass on where the version of Dear ImGui takes it.
template <typename Info>
void initialise(Info& info, VkRenderPass renderPass) {
  if constexpr (requires { info.PipelineInfoMain; }) {  // Since 1.92.4.
    info.PipelineInfoMain.RenderPass = renderPass;
    ImGui_ImplVulkan_Init(&info);
  } else if constexpr (requires { info.RenderPass; }) {  // Since 1.90.4.
    info.RenderPass = renderPass;
    ImGui_ImplVulkan_Init(&info);
  } else {
    ImGui_ImplVulkan_Init(&info, renderPass);
  }
}

}  // namespace

Interface::Interface(const GpuDevice& device, const Window& window, std::uint32_t framesInFlight)
    : device_(device), window_(window), framesInFlight_(framesInFlight) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // Without this, ImGui would write a settings file.
  ImGui::StyleColorsDark();
  ImGui_ImplGlfw_InitForVulkan(window.handle(), true);

  // As many as any version of Dear ImGui asks for. Since April 2026, its samplers have descriptors of their own.
  constexpr std::array kSizes{VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 8},
                              VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 8},
                              VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_SAMPLER, 2}};
  VkDescriptorPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  info.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
  for (const VkDescriptorPoolSize& size : kSizes) info.maxSets += size.descriptorCount;
  info.poolSizeCount = kSizes.size();
  info.pPoolSizes = kSizes.data();
  fg::vk::check(vkCreateDescriptorPool(device.device().context().view.device, &info, nullptr, &descriptors_),
                "creating a descriptor pool");
}

Interface::~Interface() {
  if (prepared_) {
    ImGui_ImplVulkan_Shutdown();
  }
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  vkDestroyDescriptorPool(device_.device().context().view.device, descriptors_, nullptr);
}

void Interface::prepare(VkRenderPass renderPass, fg::vk::FrameQueue& queue) {
  const fg::vk::DeviceContext& context = device_.device().context();
  ImGui_ImplVulkan_InitInfo info{};
  info.Instance = context.view.instance;
  info.PhysicalDevice = context.view.physicalDevice;
  info.Device = context.view.device;
  info.QueueFamily = context.view.queueFamily;
  info.Queue = device_.device().queue();
  info.DescriptorPool = descriptors_;
  info.MinImageCount = std::max(2U, framesInFlight_);
  info.ImageCount = info.MinImageCount;
  info.CheckVkResultFn = checkInterface;
  initialise(info, renderPass);
  prepared_ = true;
#if IMGUI_VERSION_NUM < 19000
  const fg::vk::Frame upload = queue.begin();
  ImGui_ImplVulkan_CreateFontsTexture(upload.commandBuffer);
  queue.submit(upload);
  queue.waitAll();
  ImGui_ImplVulkan_DestroyFontUploadObjects();
#else
  (void)queue;  // Fonts are uploaded with the first frame.
#endif
}

void Interface::update(Session& session, const LiveFrame& live, const FrameFacts& facts, const Rectangle& place) {
  ImGui_ImplVulkan_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  constexpr auto kWidth = static_cast<float>(kPanelWidth);
  const float left = std::max(0.0F, size.x - kWidth);
  const float width = std::min(kWidth, size.x);
  float foot = refusalPanel(session, {left, size.y}, width);
  foot += findingsPanel(facts, {left, size.y - foot}, width);
  ImGui::SetNextWindowPos({left, 0.0F});
  ImGui::SetNextWindowSize({width, size.y - foot});
  constexpr ImGuiWindowFlags kFixed =
      ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoTitleBar;
  ImGui::Begin("walr", nullptr, kFixed);
  playPanel(session);
  viewPanel(session, live, viewableTextures(live.graph().desc()), !facts.deviceTraces);
  methodPanel(session, live);
  if (ImGui::CollapsingHeader("Times", ImGuiTreeNodeFlags_DefaultOpen)) {
    timesPanel(session, facts, device_.isSoftware());
  }
  if (ImGui::CollapsingHeader("Memory", ImGuiTreeNodeFlags_DefaultOpen)) {
    memoryPanel(live.graph().desc(), live.plan(), facts);
  }
  if (ImGui::CollapsingHeader("Settings", ImGuiTreeNodeFlags_DefaultOpen)) {
    settingsPanel(session);
  }
  ImGui::End();
  labelComparison(session, place);
  takeEdgeInput(session, place);
  if (!session.holdsEdge()) takeCameraInput(session);
  ImGui::Render();
}

void Interface::takeEdgeInput(Session& session, const Rectangle& place) const {
  const ImGuiIO& io = ImGui::GetIO();
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left) || place.width == 0) {
    session.releaseEdge();
    return;
  }
  constexpr float kReach = 8.0F;  // Pixels of the window.
  const float scale = static_cast<float>(session.tracer().extent().width) / static_cast<float>(place.width);
  const float column = (io.MousePos.x - static_cast<float>(place.x)) * scale;
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !io.WantCaptureMouse) session.grabEdge(column, kReach * scale);
  session.moveEdge(column);
}

void Interface::takeCameraInput(Session& session) const {
  const ImGuiIO& io = ImGui::GetIO();
  if (session.cameraMode() == CameraMode::Scene || io.DisplaySize.y <= 0.0F) {
    return;
  }
  CameraInput input;
  if (!io.WantCaptureMouse) {
    constexpr float kRadiansPerHeight = 3.0F;
    const glm::vec2 dragged = glm::vec2(io.MouseDelta.x, io.MouseDelta.y) / io.DisplaySize.y;
    if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
      input.turn = dragged * kRadiansPerHeight;
    }
    if (ImGui::IsMouseDown(ImGuiMouseButton_Right)) {
      input.pan = dragged;
    }
    input.zoom = io.MouseWheel;
  }
  if (!io.WantCaptureKeyboard) {
    const auto axis = [&](int positive, int negative) {
      return (window_.keyDown(positive) ? 1.0F : 0.0F) - (window_.keyDown(negative) ? 1.0F : 0.0F);
    };
    const glm::vec3 direction(axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q), axis(GLFW_KEY_W, GLFW_KEY_S));
    input.move = direction * (session.flySpeed() * io.DeltaTime);
  }
  session.moveCamera(input);
}

void Interface::draw(VkCommandBuffer commandBuffer) {
  ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commandBuffer);
}

}  // namespace walr::host
