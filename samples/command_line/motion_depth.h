#pragma once

#include <CLI/CLI.hpp>

#include "samples/sequence/sequence.h"

namespace walr {

/// Adds `--motion-depth` to a subcommand that reads sequences.
void addMotionDepth(CLI::App& command, SequenceOptions& options);

}  // namespace walr
