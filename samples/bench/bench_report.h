#pragma once

#include <iosfwd>
#include <string>

#include "samples/bench/bench.h"

namespace walr {

/// The whole report as JSON, in the format of samples/bench/bench.schema.json.
/// @param command  the command line of the run
std::string benchJson(const BenchReport& report, const std::string& command);

/// Print one table per sequence with some errors and times. `report.html` and `bench.csv` contain the rest.
void printSummary(std::ostream& stream, const BenchReport& report);

}  // namespace walr
