#pragma once

#include <string>

#include "samples/bench/bench_report.h"
#include "tests/samples/schema_check.h"
#include "tests/samples/synthetic_sequence.h"
#include "tests/samples/temporary_directory.h"

namespace walr::test {

/// Violations of the schema of `bench.json` in a report; empty if there are none.
inline std::string schemaTroubles(BenchReport report) {
  report.repetitions = 1;
  const TemporaryDirectory directory;
  writeText(directory.path() / "bench.json", benchJson(report, "walr bench"));
  return schemaTroubles("samples/bench/bench.schema.json", directory.path() / "bench.json");
}

}  // namespace walr::test
