#pragma once

#include <string>

#include "samples/gpu_report/gpu_report.h"

namespace walr {

/// The report as JSON, in the format of samples/gpu_report/gpu_report.schema.json.
/// @param command the command line of the run
std::string gpuReportJson(const GpuReport& report, const std::string& command);

}  // namespace walr
