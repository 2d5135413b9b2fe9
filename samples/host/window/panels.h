#pragma once

#include <string>
#include <vector>

#include "framegraph/declare/graph.h"
#include "framegraph/plan/plan.h"
#include "samples/host/session.h"
#include "samples/host/window/interface.h"

/// The parts of the interface's panel. Each is to be called between ImGui::Begin and ImGui::End.
namespace walr::host {

/// Pause, freeze, camera, cut, history.
void playPanel(Session& session);
/// What is shown.
void viewPanel(Session& session, const std::vector<std::string>& textures);
/// Method and presets.
void methodPanel(Session& session);
/// A widget for every setting of the method, with the range that the setting itself tells.
void settingsPanel(Session& session);
/// Times of tracing and of every pass.
void timesPanel(const FrameFacts& facts, bool softwareDevice);
/// Shared memory over passes: a rectangle a texture, grey for histories.
void memoryPanel(const fg::GraphDesc& graph, const fg::Plan& plan);

}  // namespace walr::host
