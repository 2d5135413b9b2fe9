#include "samples/bench/html_report.h"

#include <spawn.h>
#include <sys/wait.h>

#include <cstring>
#include <span>

#include "samples/bench/report_scripts.h"
#include "samples/image/file_output.h"

namespace walr {
namespace {

/// @returns the exit code, or -1 where the program cannot be run
int run(std::string program, std::string script, std::string argument) {
  char* const arguments[] = {program.data(), script.data(), argument.data(), nullptr};
  pid_t process = 0;
  if (posix_spawnp(&process, program.c_str(), nullptr, nullptr, arguments, environ) != 0) return -1;
  int status = 0;
  if (waitpid(process, &status, 0) < 0 || !WIFEXITED(status)) return -1;
  return WEXITSTATUS(status);
}

}  // namespace

std::string writeHtmlReport(const std::filesystem::path& output, const std::string& python) {
  for (const ReportScript& script : kReportScripts) {
    writeFileAtomically(output / script.file, std::as_bytes(std::span(script.text)));
  }
  const std::filesystem::path script = output / "report.py";
  const int code = run(python, script.string(), output.string());
  if (code == 0) return {};
  return "no report.html: '" + python + " " + script.string() + " " + output.string() + "' " +
         (code < 0 ? "cannot be run" : "failed") +
         ". It needs Python 3 with matplotlib (Debian: python3-matplotlib); --python names another interpreter";
}

}  // namespace walr
