#include "samples/host/follow_session.h"

#include <exception>

namespace walr::host {
namespace {

/// @param resized  the graph must be declared anew in any case
Followed apply(LiveFrame& live, Session& session, GraphChange change, bool resized) {
  if (change == GraphChange::Settings && live.update(session.method(), session.view())) return Followed::Updated;
  if (session.dragging && live.declared() && !resized) return Followed::Waits;
  // While the session is frozen, only the current frame is available: it is denoised again, without history.
  const bool anew = change == GraphChange::Method || session.frozen;
  live.declare(session.method(), session.view(), anew ? LiveFrame::Start::Anew : LiveFrame::Start::FromHistory);
  return Followed::Declared;
}

}  // namespace

Followed followSession(LiveFrame& live, Session& session, GraphChange change, fg::Extent extent) {
  const bool resized = live.extent() != extent;
  live.setExtent(extent);
  try {
    const Followed followed = apply(live, session, change, resized);
    if (followed != Followed::Waits) session.accept();
    return followed;
  } catch (const std::exception& error) {
    if (!session.refuse(error.what())) throw;
  }
  return resized || !live.declared() ? apply(live, session, GraphChange::Settings, true) : Followed::Refused;
}

std::string refusalOf(const LiveFrame& live, Denoiser& method, const HostView& view) {
  try {
    live.check(method, view);
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

}  // namespace walr::host
