#include "samples/host/window/panels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <functional>
#include <limits>
#include <span>

#include <imgui.h>

#include "framegraph/plan/memory_places.h"
#include "passes/settings/settings.h"
#include "samples/command_line/resampled_frames.h"
#include "samples/host/follow_session.h"

namespace walr::host {
namespace {

constexpr double kMegabyte = 1024.0 * 1024.0;

/// A tooltip with lines of a width that is easy to read.
void showTooltip(const std::string& text) {
  constexpr float kWidth = 400.0F;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(kWidth);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

/// Why a name cannot be chosen; empty if it can.
using Refusal = std::function<std::string(const std::string& name)>;

/// A combo box, in which names that cannot be chosen are grey. Returns the index of a newly chosen name; nullopt if the
/// choice has not changed.
std::optional<std::size_t> choose(const char* label, std::span<const std::string> names, const std::string& current,
                                  const Refusal& refusal = {}) {
  std::optional<std::size_t> chosen;
  if (ImGui::BeginCombo(label, current.c_str(), ImGuiComboFlags_HeightLargest)) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::string reason = refusal && names[i] != current ? refusal(names[i]) : "";
      const ImGuiSelectableFlags flags = reason.empty() ? 0 : ImGuiSelectableFlags_Disabled;
      if (ImGui::Selectable(names[i].c_str(), names[i] == current, flags) && names[i] != current) {
        chosen = i;
      }
      if (!reason.empty() && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) showTooltip(reason);
    }
    ImGui::EndCombo();
  }
  return chosen;
}

/// Makes a widget for each setting, and records whether a value has changed.
class SettingWidgets : public SettingVisitor {
 public:
  /// @param lights that are denoised; settings that act on none of them have no widget
  explicit SettingWidgets(LightKinds lights) : lights_(lights) {}

  void visit(const SettingInfo& info, float& value) override {
    if (!haveInCommon(info.lights, lights_)) return;
    const auto least = static_cast<float>(info.least);
    const auto most = static_cast<float>(info.most);
    if (std::isinf(most)) {
      visitUnbounded(info, value);
      return;
    }
    constexpr double kDecades = 1000.0;
    const bool wide = info.least > 0.0 && info.most / info.least >= kDecades;
    const bool moved = ImGui::SliderFloat(label(info).c_str(), &value, least, most, "%.4g",
                                          ImGuiSliderFlags_AlwaysClamp | (wide ? ImGuiSliderFlags_Logarithmic : 0));
    finishSlider(info, moved);
  }

  void visit(const SettingInfo& info, std::uint32_t& value) override {
    if (!haveInCommon(info.lights, lights_)) return;
    const auto least = static_cast<std::uint32_t>(info.least);
    const auto most = static_cast<std::uint32_t>(info.most);
    const bool moved = ImGui::SliderScalar(label(info).c_str(), ImGuiDataType_U32, &value, &least, &most, "%u",
                                           ImGuiSliderFlags_AlwaysClamp);
    finishSlider(info, moved);
  }

  void visit(const SettingInfo& info, bool& value) override {
    if (haveInCommon(info.lights, lights_)) finish(info, ImGui::Checkbox(label(info).c_str(), &value));
  }

  void choice(const SettingInfo& info, std::span<const std::string_view> names, std::uint32_t& value) override {
    if (!haveInCommon(info.lights, lights_)) return;
    const std::vector<std::string> texts(names.begin(), names.end());
    const std::optional<std::size_t> chosen = choose(label(info).c_str(), texts, texts.at(value));
    value = static_cast<std::uint32_t>(chosen.value_or(value));
    finish(info, chosen.has_value());
  }

  [[nodiscard]] bool changed() const { return changed_; }
  /// Whether a slider is being dragged.
  [[nodiscard]] bool dragging() const { return dragging_; }

 private:
  // A slider needs an upper end, so an unbounded setting has a number field, and a button for infinity.
  void visitUnbounded(const SettingInfo& info, float& value) {
    const float spacing = ImGui::GetStyle().ItemInnerSpacing.x;
    const float button = ImGui::CalcTextSize("inf").x + 2.0F * ImGui::GetStyle().FramePadding.x;
    ImGui::PushID(label(info).c_str());
    ImGui::SetNextItemWidth(ImGui::CalcItemWidth() - button - spacing);
    ImGui::InputFloat("##number", &value, 0.0F, 0.0F, "%.4g");
    value = std::max(value, static_cast<float>(info.least));
    finish(info, ImGui::IsItemDeactivatedAfterEdit());
    ImGui::SameLine(0.0F, spacing);
    const bool unlimited = ImGui::Button("inf");
    if (unlimited) {
      value = std::numeric_limits<float>::infinity();
    }
    finish(info, unlimited);
    ImGui::PopID();
    ImGui::SameLine(0.0F, spacing);
    ImGui::TextUnformatted(label(info).c_str());
  }

  static std::string label(const SettingInfo& info) { return std::string(info.name); }

  void finishSlider(const SettingInfo& info, bool moved) {
    dragging_ = dragging_ || ImGui::IsItemActive();
    finish(info, moved || ImGui::IsItemDeactivatedAfterEdit());
  }

  void finish(const SettingInfo& info, bool changed) {
    changed_ = changed_ || changed;
    if (ImGui::IsItemHovered()) {
      const std::string text = descriptionOf(info) + (info.unit.empty() ? "" : "\nUnit: " + std::string(info.unit)) +
                               "\nSource: " + std::string(info.source);
      ImGui::SetTooltip("%s", text.c_str());
    }
  }

  LightKinds lights_;
  bool changed_ = false;
  bool dragging_ = false;
};

/// A chart of times in milliseconds, from 0 to the largest, which stands in it.
void chart(const char* label, const std::deque<float>& times) {
  if (times.empty()) return;
  const std::vector<float> values(times.begin(), times.end());
  const float largest = std::ranges::max(values);
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "up to %.1f ms", static_cast<double>(largest));
  constexpr float kHeight = 30.0F;
  ImGui::PlotLines(label, values.data(), static_cast<int>(values.size()), 0, text.data(), 0.0F, largest,
                   {ImGui::GetContentRegionAvail().x, kHeight});
}

/// The time that a frame shall take, and the size that it has for that.
void holdTimeWidgets(Session& session) {
  auto target = static_cast<float>(session.targetMilliseconds);
  ImGui::SetNextItemWidth(120.0F);
  if (ImGui::DragFloat("##target", &target, 0.1F, 0.0F, 1000.0F, target > 0.0F ? "%.1f ms" : "any time")) {
    session.targetMilliseconds = std::max(0.0F, target);
  }
  const fg::Extent full = session.tracer().extent();
  const fg::Extent extent = session.extent.value_or(full);
  ImGui::SameLine();
  ImGui::Text("a frame: %u x %u of %u x %u", extent.width, extent.height, full.width, full.height);
}

/// Whether light is resampled, and from how many frames. Grey if the tracer cannot.
void resamplingWidgets(Session& session) {
  const std::string reason = session.tracer().whyNotResampled();
  ImGui::BeginDisabled(!reason.empty());
  ImGui::Checkbox("Resample indirect light of", &session.resample);
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
    showTooltip(!reason.empty() ? reason : "As in ReSTIR GI without spatial reuse");
  }
  ImGui::SameLine();
  auto frames = static_cast<int>(session.resampledFrames);
  constexpr float kWidth = 60.0F;
  ImGui::SetNextItemWidth(kWidth);
  if (ImGui::DragInt("frames", &frames, 0.2F, 1, kMostResampledFrames, "%d", ImGuiSliderFlags_AlwaysClamp)) {
    session.resampledFrames = static_cast<std::uint32_t>(frames);
  }
  ImGui::EndDisabled();
}

/// Milliseconds of the passes of the method on the right of a comparison.
double comparedTime(std::span<const fg::vk::PassTime> passes) {
  double sum = 0.0;
  for (const fg::vk::PassTime& pass : passes) {
    if (pass.name.starts_with(kComparedPrefix)) sum += pass.milliseconds;
  }
  return sum;
}

ImU32 colourOf(std::size_t index) {
  // Hues that differ by the golden angle are easy to tell apart, whatever their number.
  constexpr float kGoldenAngle = 0.381966F;
  const float hue = std::fmod(static_cast<float>(index) * kGoldenAngle, 1.0F);
  return ImGui::GetColorU32(static_cast<ImVec4>(ImColor::HSV(hue, 0.55F, 0.8F)));
}

/// A text at the foot of the panel, which takes at most half of what is above `corner`: a longer one is scrolled.
/// @returns its height; 0 if there is none
float footPanel(const char* name, const std::string& message, ImU32 colour, const ImVec2& corner, float width) {
  if (message.empty()) return 0.0F;
  const char* const text = message.c_str();
  const ImVec2 padding = ImGui::GetStyle().WindowPadding;
  const float lines = ImGui::CalcTextSize(text, nullptr, false, width - 2.0F * padding.x).y;
  const float height = std::min(lines + 2.0F * padding.y, 0.5F * corner.y);
  ImGui::SetNextWindowPos({corner.x, corner.y - height});
  ImGui::SetNextWindowSize({width, height});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, colour);
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav);
  ImGui::TextWrapped("%s", text);
  ImGui::End();
  ImGui::PopStyleColor();
  return height;
}

}  // namespace

void labelComparison(const Session& session, const Rectangle& place) {
  if (session.view().kind != HostView::Kind::Compare || place.width == 0) return;
  const float scale = static_cast<float>(place.width) / static_cast<float>(session.tracer().extent().width);
  const float edge = static_cast<float>(place.x) + scale * static_cast<float>(session.viewConstants.middleEdge);
  ImDrawList* const draw = ImGui::GetBackgroundDrawList();
  constexpr float kGap = 8.0F;
  const float row = static_cast<float>(place.y) + kGap;
  const auto label = [&](const std::string& method, bool left) {
    const std::string text = method == "none" ? "noisy" : method;
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float column = left ? edge - kGap - size.x : edge + kGap;
    const float first = static_cast<float>(place.x);
    if (column < first || column + size.x > first + static_cast<float>(place.width)) return;
    constexpr float kMargin = 3.0F;
    draw->AddRectFilled({column - kMargin, row - kMargin}, {column + size.x + kMargin, row + size.y + kMargin},
                        IM_COL32(0, 0, 0, 140), kMargin);
    draw->AddText({column, row}, IM_COL32_WHITE, text.c_str());
  };
  label(session.methodName(), true);
  label(session.comparedName(), false);
}

void playPanel(Session& session) {
  ImGui::Checkbox("Pause", &session.paused);
  ImGui::SameLine();
  ImGui::Checkbox("Freeze", &session.frozen);
  ImGui::SameLine();
  if (ImGui::Button("Camera cut")) {
    session.cutCamera();
  }
  ImGui::SameLine();
  if (ImGui::Button("Reset history")) {
    session.resetHistory();
  }
  if (!session.message.empty()) ImGui::TextWrapped("%s", session.message.c_str());
  ImGui::Text("Frame %d of %d to %d", session.animationFrame(), session.frames().first, session.frames().last);
  constexpr std::array kCameras = {std::pair(CameraMode::Scene, "Scene camera"), std::pair(CameraMode::Orbit, "Orbit"),
                                   std::pair(CameraMode::Fly, "Fly (WASD, QE)")};
  for (const auto& [mode, name] : kCameras) {
    if (ImGui::RadioButton(name, session.cameraMode() == mode)) {
      session.chooseCamera(mode);
    }
    ImGui::SameLine();
  }
  ImGui::NewLine();
  ImGui::Checkbox("Objects and lights move", &session.objectsMove);
  ImGui::SameLine();
  bool lint = session.view().lint;
  if (ImGui::Checkbox("Check inputs", &lint)) session.chooseLint(lint);
}

void viewPanel(Session& session, const LiveFrame& live, const std::vector<std::string>& textures, bool references) {
  ImGui::Separator();
  const HostView& view = session.view();
  const std::array<std::string, 6> all = {"denoised", "noisy", "reference", "split", "compare", "texture"};
  std::vector<HostView::Kind> kinds;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const HostView offered{static_cast<HostView::Kind>(i), ""};
    if (offered.needsReference() && !references) continue;
    kinds.push_back(offered.kind);
    names.push_back(all.at(i));
  }
  if (const auto chosen = choose("View", names, all.at(static_cast<std::size_t>(view.kind)))) {
    HostView next{kinds[*chosen], ""};
    if (next.kind == HostView::Kind::Texture) {
      next.texture = textures.front();
    }
    if (next.kind == HostView::Kind::Compare) {
      chooseComparison(live, session);
    } else {
      session.chooseView(next);
    }
  }
  ViewConstants& constants = session.viewConstants;
  if (view.kind == HostView::Kind::Texture) {
    if (const auto chosen = choose("Texture", textures, view.texture)) {
      session.chooseView({HostView::Kind::Texture, textures[*chosen]});
    }
    ImGui::DragFloat("Gain", &constants.gain, 0.01F, 0.0F, 1000.0F, "%.3f");
    ImGui::DragFloat("Bias", &constants.bias, 0.01F, -10.0F, 10.0F, "%.3f");
  } else if (view.kind == HostView::Kind::Compare) {
    const std::vector<std::string> methods = denoiserNames();
    const Refusal refusal = [&](const std::string& name) { return refusalOfCompared(live, session, name); };
    if (const auto chosen = choose("On the right", methods, session.comparedName(), refusal)) {
      session.compareWith(methods[*chosen], makeDenoiser(methods[*chosen]));
    }
  } else if (view.kind == HostView::Kind::Split) {
    ImGui::DragIntRange2("Edges", &constants.leftEdge, &constants.rightEdge, 1.0F, 0, 16384);
  }
}

void methodPanel(Session& session, const LiveFrame& live) {
  ImGui::Separator();
  const std::vector<std::string> methods = denoiserNames();
  const Refusal ofMethod = [&](const std::string& name) { return refusalOfMethod(live, session, name); };
  if (const auto chosen = choose("Method", methods, session.methodName(), ofMethod)) {
    session.chooseMethod(methods[*chosen]);
  }
  const std::vector<std::string> presets = session.method().presets();
  if (presets.empty()) {
    return;
  }
  const Refusal ofPreset = [&](const std::string& name) { return refusalOfPreset(live, session, name); };
  if (const auto chosen = choose("Preset", presets, session.preset().value_or("(settings changed)"), ofPreset)) {
    session.choosePreset(presets[*chosen]);
  }
}

void settingsPanel(Session& session) {
  constexpr float kLabelWidth = 0.5F;
  ImGui::PushItemWidth(ImGui::GetContentRegionAvail().x * kLabelWidth);
  SettingWidgets widgets({.diffuse = true, .specular = session.tracer().specular()});
  session.method().visitSettings(widgets);
  ImGui::PopItemWidth();
  session.dragging = widgets.dragging();
  if (widgets.changed()) {
    session.settingsChanged();
  }
}

void timesPanel(Session& session, const FrameFacts& facts, bool softwareDevice) {
  constexpr double kMilliseconds = 1000.0;
  if (facts.deviceTraces) {
    ImGui::Text("Paths: traced on the device, %s", rateText(facts.traced).c_str());
  } else {
    ImGui::Text("Paths: traced by Embree, %.0f ms, %s", facts.traced.seconds * kMilliseconds,
                rateText(facts.traced).c_str());
    chart("##tracing", facts.tracingHistory);
  }
  ImGui::Text("Direct light: %s", session.tracer().denoisesDirect() ? "denoised" : "noisy");
  resamplingWidgets(session);
  holdTimeWidgets(session);
  double sum = 0.0;
  for (const fg::vk::PassTime& pass : facts.passTimes) {
    sum += pass.milliseconds;
  }
  const char* const software = softwareDevice ? " (software device)" : "";
  if (facts.passTimes.empty()) {
    ImGui::Text("Device: no times%s", software);
  } else {
    ImGui::Text("Device %.2f ms%s", sum, software);
  }
  const double compared = comparedTime(facts.passTimes);
  if (compared > 0.0) ImGui::Text("of which on the right %.2f ms", compared);
  chart("##device", facts.deviceHistory);
  for (const fg::vk::PassTime& pass : facts.passTimes) {
    const auto share = static_cast<float>(sum > 0.0 ? pass.milliseconds / sum : 0.0);
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2f ms", pass.milliseconds);
    ImGui::ProgressBar(share, {120.0F, 0.0F}, text.data());
    ImGui::SameLine();
    ImGui::TextUnformatted(pass.name.c_str());
  }
}

void memoryPanel(const fg::GraphDesc& graph, const fg::Plan& plan, const FrameFacts& facts) {
  const fg::MemoryReport& memory = plan.memory;
  ImGui::Text("Device memory: frame graph %.1f MiB", static_cast<double>(facts.graphBytes) / kMegabyte);
  if (facts.deviceTraces) {
    ImGui::SameLine(0.0F, 0.0F);
    ImGui::Text(", scene %.1f MiB", static_cast<double>(facts.sceneBytes) / kMegabyte);
  }
  if (facts.memory) {
    ImGui::Text("Whole program %.0f of %.0f MiB", static_cast<double>(facts.memory->used) / kMegabyte,
                static_cast<double>(facts.memory->budget) / kMegabyte);
  }
  ImGui::Text("Transient %.1f MiB (%.1f unshared), persistent %.1f MiB",
              static_cast<double>(memory.transientPeakBytes) / kMegabyte,
              static_cast<double>(memory.transientUnaliasedBytes) / kMegabyte,
              static_cast<double>(memory.persistentBytes) / kMegabyte);
  const float width = ImGui::GetContentRegionAvail().x;
  constexpr float kHeight = 120.0F;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("memory", {width, kHeight});
  ImDrawList* const draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(corner, {corner.x + width, corner.y + kHeight}, ImGui::GetColorU32(ImGuiCol_FrameBg));
  std::vector<double> heapStarts;
  double bytes = 0.0;
  for (const fg::PlannedHeap& heap : plan.heaps) {
    heapStarts.push_back(bytes);
    bytes += static_cast<double>(heap.size);
  }
  bytes = std::max(1.0, bytes);
  const auto column = [&](std::uint32_t pass) {
    return corner.x +
           width * static_cast<float>(pass) / static_cast<float>(std::max<std::size_t>(1, plan.passes.size()));
  };
  const auto row = [&](double offset) { return corner.y + kHeight * static_cast<float>(1.0 - offset / bytes); };
  for (std::size_t i = 0; i < plan.resources.size(); ++i) {
    const fg::PlannedResource& resource = plan.resources[i];
    if (resource.heap == fg::kNone || !resource.used) {
      continue;
    }
    const fg::PassSpan span = fg::occupied(graph, plan, static_cast<std::uint32_t>(i));
    const double from = heapStarts[resource.heap] + static_cast<double>(resource.offset);
    const ImVec2 low(column(span.first), row(from + static_cast<double>(resource.size)));
    const ImVec2 high(column(span.last + 1), row(from));
    const bool transient = graph.resources[i].lifetime == fg::Lifetime::Transient;
    draw->AddRectFilled(low, high, transient ? colourOf(i) : ImGui::GetColorU32(ImGuiCol_TextDisabled));
    draw->AddRect(low, high, ImGui::GetColorU32(ImGuiCol_WindowBg));
    if (ImGui::IsMouseHoveringRect(low, high)) {
      ImGui::SetTooltip("%s: %.2f MiB, from '%s' to '%s'", graph.resources[i].name.c_str(),
                        static_cast<double>(resource.size) / kMegabyte,
                        graph.passes[plan.passes[resource.firstUse].pass].name.c_str(),
                        graph.passes[plan.passes[resource.lastUse].pass].name.c_str());
    }
  }
}

float refusalPanel(const Session& session, const ImVec2& corner, float width) {
  return footPanel("refusal", session.refusal(), IM_COL32(110, 50, 20, 255), corner, width);
}

float findingsPanel(const FrameFacts& facts, const ImVec2& corner, float width) {
  std::string text;
  for (const LintFinding& finding : facts.findings) text += (text.empty() ? "" : "\n\n") + finding.text();
  return footPanel("findings", text, IM_COL32(80, 20, 90, 255), corner, width);
}

}  // namespace walr::host
