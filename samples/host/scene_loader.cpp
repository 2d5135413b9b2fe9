#include "samples/host/scene_loader.h"

#include <chrono>
#include <exception>
#include <string>
#include <utility>

namespace walr::host {

SceneLoader::SceneLoader(Tracer& tracer, Session& session, Read read)
    : tracer_(tracer), session_(session), read_(std::move(read)) {
  if (!read_) read_ = [this](const std::filesystem::path& file) { return tracer_.read(file); };
}

void SceneLoader::start(const std::filesystem::path& file) {
  session_.message = "Loading " + file.filename().string();
  if (reading_.valid()) {
    following_ = file;
    return;
  }
  file_ = file;
  reading_ = std::async(std::launch::async, read_, file);
}

bool SceneLoader::done() {
  if (!reading_.valid() || reading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
  if (!following_) return true;
  reading_ = {};
  start(*std::exchange(following_, std::nullopt));
  return false;
}

bool SceneLoader::finish() {
  try {
    tracer_.show(reading_.get());
  } catch (const std::exception& error) {
    const std::string reason = error.what();
    // Most errors name the file, with its folder.
    const bool named = reason.find(file_.string()) != std::string::npos;
    session_.message = "Not opened: " + (named ? reason : file_.string() + ": " + reason);
    return false;
  }
  session_.sceneChanged();
  session_.message = file_.filename().string();
  for (const std::string& warning : tracer_.warnings()) session_.message += "\n" + warning;
  return true;
}

}  // namespace walr::host
