#pragma once

#include <iosfwd>
#include <string>

#include "samples/bench/bench.h"

namespace walr {

/// The whole report as JSON (samples/docs/bench.md says what is in it).
/// @param command  the command line that made it
std::string benchJson(const BenchReport& report, const std::string& command);

/// One line a sequence and variant, with a header.
std::string benchCsv(const BenchReport& report);

/// A table for people, one a sequence and one of the means over them.
void printBench(std::ostream& stream, const BenchReport& report);

}  // namespace walr
