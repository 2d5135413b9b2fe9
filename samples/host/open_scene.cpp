#include "samples/host/open_scene.h"

#include <exception>
#include <string>

namespace walr::host {

bool openScene(const std::filesystem::path& file, Tracer& tracer, Session& session) {
  try {
    tracer.open(file);
  } catch (const std::exception& error) {
    const std::string reason = error.what();
    // Most errors name the file, with its folder.
    const bool named = reason.find(file.string()) != std::string::npos;
    session.message = "Not opened: " + (named ? reason : file.string() + ": " + reason);
    return false;
  }
  session.sceneChanged();
  session.message = file.filename().string();
  for (const std::string& warning : tracer.warnings()) session.message += "\n" + warning;
  return true;
}

}  // namespace walr::host
