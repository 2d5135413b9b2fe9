#pragma once

#include <filesystem>
#include <string>

#include "tests/samples/process.h"

namespace walr::test {

/// Violations of one of the project's JSON Schemas in a file, found by check_json.py; empty if there are none.
/// @param schema  path of the schema within the project
inline std::string schemaTroubles(const std::string& schema, const std::filesystem::path& file) {
  const std::string project = WALR_PROJECT "/";
  const ProcessResult result =
      runProcess({"/usr/bin/python3", project + "tests/samples/check_json.py", project + schema, file.string()});
  return result.exitCode == 0 ? "" : file.string() + ": " + result.out + result.err;
}

}  // namespace walr::test
