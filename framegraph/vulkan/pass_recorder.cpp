#include "framegraph/vulkan/pass_recorder.h"

#include <array>
#include <cstring>
#include <string>

#include "framegraph/vulkan/dispatch.h"
#include "framegraph/vulkan/label.h"

namespace fg::vk {
namespace {

/// Vulkan allows views only of images with one of these usage flags.
constexpr VkImageUsageFlags kViewableUsage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT |
                                             VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                             VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;

void requireGroups(const DeviceContext& device, const PassDecl& pass, const ComputeDispatch& work) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::uint32_t most = device.properties.limits.maxComputeWorkGroupCount[axis];
    if (work.indirect.valid() || work.groups[axis] <= most) continue;
    throw Unsupported("pass '" + pass.name + "' dispatches " + std::to_string(work.groups[axis]) +
                          " work groups along axis " + std::to_string(axis) + ", the device takes " +
                          std::to_string(most) + ": use smaller textures or larger work groups",
                      VK_ERROR_FEATURE_NOT_PRESENT);
  }
}

}  // namespace

PassRecorder::PassRecorder(const DeviceContext& device, const GraphDesc& graph, const Plan& plan,
                           const Resources& resources, Views& views, Pipelines& pipelines, std::uint32_t slots,
                           const Options& options)
    : device_(&device),
      plan_(&plan),
      resources_(&resources),
      views_(&views),
      pipelines_(&pipelines),
      steps_(makeSteps(device, graph, plan, pipelines, options.poison)),
      callbackViews_(graph.resources.size(), kNone),
      descriptors_(device, graph, plan, resources, views, setLayouts(), slots, options.inheritsHistories) {
  for (const Step& step : steps_) {
    if (std::holds_alternative<HostCallback>(step.pass->work)) requestCallbackViews(*step.pass);
  }
  const auto requireDeclared = [this](ResourceVersion handle) {
    static_cast<void>(plan_->resources.at(handle.resource));
  };
  context_.image = [this, requireDeclared](Texture texture) {
    requireDeclared(texture);
    return resources_->image(texture.resource, frame_);
  };
  context_.view = [this](Texture texture) {
    const std::uint32_t view = callbackViews_.at(texture.resource);
    return view == kNone ? VK_NULL_HANDLE : views_->get(view, frame_);
  };
  context_.buffer = [this, requireDeclared](Buffer buffer) {
    requireDeclared(buffer);
    return resources_->buffer(buffer.resource, frame_);
  };
}

std::vector<PassRecorder::Step> PassRecorder::makeSteps(const DeviceContext& device, const GraphDesc& graph,
                                                        const Plan& plan, Pipelines& pipelines, bool poison) {
  std::vector<Step> steps;
  for (const PlannedPass& planned : plan.passes) {
    Step& step = steps.emplace_back();
    step.pass = &graph.passes[planned.pass];
    step.barriers = poison ? poisonedBarriers(graph, planned) : plainBarriers(graph, planned.barriers);
    if (const auto* work = std::get_if<ComputeDispatch>(&step.pass->work)) {
      step.pipeline = makePipeline(device, *step.pass, *work, pipelines);
      step.constants = work->constants;
    }
  }
  return steps;
}

ComputePipeline PassRecorder::makePipeline(const DeviceContext& device, const PassDecl& pass,
                                           const ComputeDispatch& work, Pipelines& pipelines) {
  requireGroups(device, pass, work);
  return pipelines.get(*work.shader, work.specialization);
}

void PassRecorder::update(const GraphDesc& graph) {
  std::vector<ComputePipeline> pipelines(steps_.size());
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const PassDecl& pass = graph.passes[plan_->passes[i].pass];
    const auto* work = std::get_if<ComputeDispatch>(&pass.work);
    if (work != nullptr) pipelines[i] = makePipeline(*device_, pass, *work, *pipelines_);
  }
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const auto* work = std::get_if<ComputeDispatch>(&graph.passes[plan_->passes[i].pass].work);
    if (work == nullptr) continue;
    steps_[i].pipeline = pipelines[i];
    steps_[i].constants = work->constants;
  }
}

void PassRecorder::requestCallbackViews(const PassDecl& pass) {
  for (const AccessDecl& access : pass.accesses) {
    const bool viewable = (plan_->resources[access.resource].imageUsage & kViewableUsage) != 0;
    if (viewable) callbackViews_[access.resource] = views_->request(access.resource, SubresourceRange{});
  }
}

std::vector<VkDescriptorSetLayout> PassRecorder::setLayouts() const {
  std::vector<VkDescriptorSetLayout> layouts;
  for (const Step& step : steps_) layouts.push_back(step.pipeline.setLayout);
  return layouts;
}

void PassRecorder::record(VkCommandBuffer commandBuffer, FrameIndex frame, const HistoryStates& histories,
                          Timestamps* timestamps) {
  frame_ = frame;
  context_.commandBuffer = commandBuffer;
  descriptors_.update(frame);
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    Step& step = steps_[i];
    {
      const Label label(*device_, commandBuffer, step.pass->name.c_str());
      step.barriers.record(*device_, commandBuffer, *resources_, frame);
      if (const auto* work = std::get_if<ComputeDispatch>(&step.pass->work)) {
        dispatch(commandBuffer, i, *work, histories);
      } else {
        std::get<HostCallback>(step.pass->work).record(context_);
      }
    }
    if (timestamps != nullptr) timestamps->endPass(commandBuffer, frame.slot, static_cast<std::uint32_t>(i));
  }
}

void PassRecorder::dispatch(VkCommandBuffer commandBuffer, std::size_t index, const ComputeDispatch& work,
                            const HistoryStates& histories) {
  Step& step = steps_[index];
  for (const HistoryAgeConstant& constant : work.historyAges) {
    const std::uint32_t age = histories.status(constant.history).age;
    std::memcpy(step.constants.data() + constant.offset, &age, sizeof(age));
  }
  const VkBuffer indirect = work.indirect.valid() ? resources_->buffer(work.indirect.resource, frame_) : VK_NULL_HANDLE;
  recordDispatch(*device_, commandBuffer, step.pipeline, descriptors_.set(index, frame_),
                 {step.constants, std::to_array(work.groups), indirect, work.indirectOffset});
}

}  // namespace fg::vk
