#include "samples/command_line/channel_options.h"

namespace walr {

void addChannelOptions(CLI::App& command, SequenceOptions& options) {
  command.add_option("--view-layer", options.viewLayer, "View layer to read if the files hold several")
      ->type_name("NAME");
  command.add_option("--stereo-view", options.stereoView, "View of a stereo picture to read, such as left")
      ->type_name("NAME");
  command
      .add_option("--channels", options.channelMap,
                  "Read the channels that this JSON file names, for frames of other renderers than Cycles "
                  "(samples/docs/sequences.md)")
      ->type_name("FILE");
}

}  // namespace walr
