#pragma once

#include <filesystem>
#include <string>

namespace walr {

/// Write `report.py` and what it imports beside a benchmark's `bench.json` and run it, which makes `report.html`.
/// @param python  a Python 3 interpreter that has matplotlib
/// @returns nothing, or why there is no report, and the way out
std::string writeHtmlReport(const std::filesystem::path& output, const std::string& python);

}  // namespace walr
