#pragma once

#include <string>

#include "framegraph/declare/graph.h"
#include "passes/methods/denoiser.h"
#include "samples/host/live_frame.h"
#include "samples/host/session.h"

namespace walr::host {

/// What became of a graph that followed the choices of a session.
enum class Followed {
  Updated,   ///< It is the same graph with other constants, and keeps all histories.
  Declared,  ///< It is another graph.
  Waits,     ///< Another graph is needed, but not while the user drags a slider.
  Refused,   ///< The choices were refused: it runs as before.
};

/// Bring the graph of a window up to date with the choices of its session. Choices that are refused, for whatever
/// reason, are put back, and `Session::refusal` tells why; the graph then is that of the choices before. If the texture
/// that is shown does not exist with the choices, the denoised image is shown instead.
/// @param change  the largest change since the last call
/// @param extent  size of the next frame
/// @throws see `LiveFrame::declare`, if the session has no earlier choices to go back to, or these are refused as well
Followed followSession(LiveFrame& live, Session& session, GraphChange change, fg::Extent extent);

/// Why a method, a preset of the session's method, or a method on the right of a comparison would be refused; empty if
/// it would not. Device objects are not made, so that a lack of memory, for instance, is not foreseen.
/// @param live  the window's graph, which does not change
std::string refusalOfMethod(const LiveFrame& live, const Session& session, const std::string& name);
std::string refusalOfPreset(const LiveFrame& live, const Session& session, const std::string& name);
std::string refusalOfCompared(const LiveFrame& live, Session& session, const std::string& name);

/// Show a comparison. If the method on its right would be refused, the first one that would not takes its place.
void chooseComparison(const LiveFrame& live, Session& session);

}  // namespace walr::host
