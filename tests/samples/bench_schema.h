#pragma once

#include <string>

#include "samples/bench/bench_report.h"
#include "tests/samples/schema_check.h"
#include "tests/samples/synthetic_sequence.h"
#include "tests/samples/temporary_directory.h"

namespace walr::test {

/// What the schema of `bench.json` finds wrong with a report; empty where nothing.
inline std::string schemaTroubles(BenchReport report) {
  report.repetitions = 1;
  const TemporaryDirectory directory;
  writeText(directory.path() / "bench.json", benchJson(report, "walr bench"));
  return schemaTroubles("samples/bench/bench.schema.json", directory.path() / "bench.json");
}

}  // namespace walr::test
