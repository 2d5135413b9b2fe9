#include "samples/bench/html_report.h"

#include "samples/bench/child_process.h"
#include "samples/bench/report_scripts.h"
#include "samples/image/file_output.h"

namespace walr {

std::string writeHtmlReport(const std::filesystem::path& output, const std::string& python) {
  for (const ReportScript& script : kReportScripts) {
    writeFileAtomically(output / script.file, script.text);
  }
  const std::filesystem::path script = output / "report.py";
  const int code = runChild({python, script.string(), output.string()}, ChildOutput::Inherited).exitCode;
  if (code == 0) return {};
  return "no report.html: '" + python + " " + script.string() + " " + output.string() + "' " +
         (code < 0 ? "cannot be run" : "failed, for the reason above") +
         ". It needs the pictures beside bench.json, and Python 3 with matplotlib (Debian: python3-matplotlib); "
         "--python can name another interpreter";
}

}  // namespace walr
