#pragma once

#include <filesystem>
#include <string>

namespace walr {

/// Write `report.py` and the modules that it imports to the folder of `bench.json`, and run it to make `report.html`.
/// @param python  a Python 3 interpreter with matplotlib
/// @returns an empty text, or why there is no report and how to get one
std::string writeHtmlReport(const std::filesystem::path& output, const std::string& python);

}  // namespace walr
