#include "samples/host/follow_session.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <vector>

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

std::string refusalOf(const LiveFrame& live, Denoiser& method, const HostView& view) {
  try {
    live.check(method, view);
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

/// The session's view, but for a texture, which other methods may lack.
HostView viewOfAnyMethod(const Session& session) {
  return session.view().kind == HostView::Kind::Texture ? HostView{} : session.view();
}

void leaveLackingTexture(const LiveFrame& live, Session& session) {
  if (session.view().kind != HostView::Kind::Texture || refusalOf(live, session.method(), session.view()).empty())
    return;
  session.chooseView({});
  session.takeGraphChange();  // The graph follows it together with what led to it.
}

}  // namespace

Followed followSession(LiveFrame& live, Session& session, GraphChange change, fg::Extent extent) {
  const bool resized = live.extent() != extent;
  live.setExtent(extent);
  if (live.declared()) leaveLackingTexture(live, session);
  try {
    const Followed followed = apply(live, session, change, resized);
    if (followed != Followed::Waits) session.accept();
    return followed;
  } catch (const std::exception& error) {
    if (!session.refuse(error.what())) throw;
  }
  return resized || !live.declared() ? apply(live, session, GraphChange::Settings, true) : Followed::Refused;
}

std::string refusalOfMethod(const LiveFrame& live, const Session& session, const std::string& name) {
  return refusalOf(live, *makeDenoiser(name), viewOfAnyMethod(session));
}

std::string refusalOfPreset(const LiveFrame& live, const Session& session, const std::string& name) {
  const std::unique_ptr<Denoiser> method = makeDenoiser(session.methodName());
  method->usePreset(name);
  return refusalOf(live, *method, viewOfAnyMethod(session));
}

std::string refusalOfCompared(const LiveFrame& live, Session& session, const std::string& name) {
  const std::unique_ptr<Denoiser> right = makeDenoiser(name);
  return refusalOf(live, session.method(), {.kind = HostView::Kind::Compare, .compared = right.get()});
}

void chooseComparison(const LiveFrame& live, Session& session) {
  const auto runs = [&](const std::string& name) { return refusalOfCompared(live, session, name).empty(); };
  if (!runs(session.comparedName())) {
    const std::vector<std::string> methods = denoiserNames();
    const auto found = std::ranges::find_if(
        methods, [&](const std::string& name) { return name != session.methodName() && runs(name); });
    if (found != methods.end()) session.compareWith(*found, makeDenoiser(*found));
  }
  session.chooseView({HostView::Kind::Compare, ""});
}

}  // namespace walr::host
