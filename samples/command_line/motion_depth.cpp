#include "samples/command_line/motion_depth.h"

#include "samples/command_line/choice.h"

namespace walr {

void addMotionDepth(CLI::App& command, SequenceOptions& options) {
  using MotionDepth = InputConventions::MotionDepth;
  addChoice<decltype(options.motionDepth), MotionDepth>(
      command, "--motion-depth", options.motionDepth,
      {{"given", MotionDepth::Given}, {"still", MotionDepth::StaticScene}, {"found", MotionDepth::Found}}, "",
      "Change of a surface's depth since the last frame: given by the third channel of motion, that of a "
      "still scene, or found in the last frame's depths; default: given if the layout has that channel, "
      "else still");
}

}  // namespace walr
