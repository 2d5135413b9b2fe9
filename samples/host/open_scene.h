#pragma once

#include <filesystem>

#include "samples/host/session.h"
#include "samples/host/tracer.h"

namespace walr::host {

/// Show another scene, as when a user drops a file onto the window. Settings stay; camera, animation and history start
/// anew. `Session::message` tells how it went. A file that cannot be read changes nothing else.
/// @param tracer  the session's; must not be tracing. The device must have finished all frames
/// @returns whether the scene is another one: graphs that trace the old one must not be recorded any more
bool openScene(const std::filesystem::path& file, Tracer& tracer, Session& session);

}  // namespace walr::host
