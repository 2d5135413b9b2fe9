#pragma once

#include <iosfwd>
#include <string>

#include "samples/bench/bench.h"

namespace walr {

/// The whole report as JSON, as samples/bench/bench.schema.json describes it.
/// @param command  the command line that made it
std::string benchJson(const BenchReport& report, const std::string& command);

/// For the console: a table a sequence, of a few errors and of times. `report.html` and `bench.csv` hold the rest.
void printSummary(std::ostream& stream, const BenchReport& report);

}  // namespace walr
