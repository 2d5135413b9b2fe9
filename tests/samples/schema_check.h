#pragma once

#include <filesystem>
#include <string>

#include "tests/samples/process.h"

namespace walr::test {

/// What a JSON Schema of the project finds wrong with a file (check_json.py); empty where nothing.
/// @param schema  its path within the project
inline std::string schemaTroubles(const std::string& schema, const std::filesystem::path& file) {
  const std::string project = WALR_PROJECT "/";
  const ProcessResult result =
      runProcess({"/usr/bin/python3", project + "tests/samples/check_json.py", project + schema, file.string()});
  return result.exitCode == 0 ? "" : file.string() + ": " + result.out + result.err;
}

}  // namespace walr::test
