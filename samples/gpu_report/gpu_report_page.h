#pragma once

#include <string>

#include "samples/gpu_report/gpu_report.h"

namespace walr {

/// The report as a page in Markdown: what a person reads first. The JSON holds more.
std::string gpuReportPage(const GpuReport& report, const std::string& command);

}  // namespace walr
