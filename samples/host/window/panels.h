#pragma once

#include <string>
#include <vector>

#include <imgui.h>

#include "framegraph/declare/graph.h"
#include "framegraph/plan/plan.h"
#include "samples/host/live_frame.h"
#include "samples/host/session.h"
#include "samples/host/window/interface.h"

/// The sections of the interface's panel. Call each between ImGui::Begin and ImGui::End.
namespace walr::host {

/// The names of both methods of a comparison, drawn beside the edge between them.
void labelComparison(const Session& session, const Rectangle& place);
/// Pause, freeze, camera, cut, history, movement of objects.
void playPanel(Session& session);
/// The displayed view.
/// @param live        what a method on the right of a comparison is tried on: one that it refuses is grey
/// @param references  whether views with a reference are offered
void viewPanel(Session& session, const LiveFrame& live, const std::vector<std::string>& textures, bool references);
/// Method and presets.
/// @param live  what methods and presets are tried on: those that it refuses are grey
void methodPanel(Session& session, const LiveFrame& live);
/// A widget for every setting of the method, with the setting's own range.
void settingsPanel(Session& session);
/// Times of tracing and of every pass, and charts of the last frames.
void timesPanel(Session& session, const FrameFacts& facts, bool softwareDevice);
/// Device memory, and a chart of it over passes: one rectangle for each resource, grey for histories.
void memoryPanel(const fg::GraphDesc& graph, const fg::Plan& plan, const FrameFacts& facts);
/// Why the last choice was refused, as a window of its own: at the foot of the panel it is seen however far the panel
/// is scrolled, and nothing moves under the mouse.
/// @param corner  lower left corner
/// @returns its height; 0 if nothing was refused
float refusalPanel(const Session& session, const ImVec2& corner, float width);
/// The same for what looks wrong in the inputs.
float findingsPanel(const FrameFacts& facts, const ImVec2& corner, float width);

}  // namespace walr::host
