#include "samples/command_line/motion_depth.h"

#include <map>
#include <string>

namespace walr {

void addMotionDepth(CLI::App& command, SequenceOptions& options) {
  using MotionDepth = InputConventions::MotionDepth;
  command
      .add_option("--motion-depth", options.motionDepth,
                  "Change of a surface's depth since the last frame: given by the third channel of motion, that of a "
                  "still scene, or found in the last frame's depths; default: given if the layout has that channel, "
                  "else still")
      ->transform(CLI::CheckedTransformer(std::map<std::string, MotionDepth>{
          {"given", MotionDepth::Given}, {"still", MotionDepth::StaticScene}, {"found", MotionDepth::Found}}))
      ->option_text("given|still|found");
}

}  // namespace walr
