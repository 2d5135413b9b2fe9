#pragma once

#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <optional>

#include "samples/host/session.h"
#include "samples/host/tracer.h"

namespace walr::host {

/// Reads scenes on a thread of its own while a session goes on with the scene that it has, as when a user drops a file
/// onto the window. Settings stay; camera, animation and history start anew. `Session::message` tells how it goes. A
/// file that cannot be read changes nothing else.
class SceneLoader {
 public:
  using Read = std::function<std::unique_ptr<Tracer::Content>(const std::filesystem::path&)>;

  /// @param tracer, session  must outlive this
  /// @param read             reads a file, on any thread; empty: `Tracer::read`
  SceneLoader(Tracer& tracer, Session& session, Read read = {});

  /// Read a file. If another one is being read, this one follows; of several that wait, only the last does.
  void start(const std::filesystem::path& file);
  /// Whether reading has ended, so that `finish` may be called. Starts to read the file that follows, if any.
  bool done();
  /// Show the scene that was read, or tell why it cannot be shown. `done` must be true, the tracer must not be tracing,
  /// and the device must have finished all frames.
  /// @returns whether the scene is another one: graphs that trace the old one must not be recorded any more
  bool finish();

 private:
  Tracer& tracer_;
  Session& session_;
  Read read_;
  std::filesystem::path file_;  // That is or was read.
  std::optional<std::filesystem::path> following_;
  std::future<std::unique_ptr<Tracer::Content>> reading_;
};

}  // namespace walr::host
