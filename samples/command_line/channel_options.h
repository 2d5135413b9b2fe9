#pragma once

#include <CLI/CLI.hpp>

#include "samples/sequence/sequence.h"

namespace walr {

/// Adds the options that say which channels of the files are read: `--view-layer`, `--stereo-view` and `--channels`.
void addChannelOptions(CLI::App& command, SequenceOptions& options);

}  // namespace walr
