#include "samples/command_line/program.h"

#include <csignal>
#include <iostream>
#include <new>
#include <string_view>

#include <unistd.h>

#include "samples/command_line/exit_code.h"

namespace walr {

namespace {

/// What a program ends with after it has written its text: a full device may take it only at the end.
int endOf(const CLI::App& program, int code) {
  std::cout.flush();
  if (code != 0 || std::cout.good()) return code;
  std::cerr << program.get_name() << ": cannot write to standard output\n";
  return static_cast<int>(ExitCode::Output);
}

/// Mesa 25 keeps the memory of its software device in a file without a name. Where that may not grow, memory that the
/// driver has handed out is not there, and the program is sent this signal where it touches it.
void endWithoutMemory(int /*signal*/) {
  constexpr std::string_view kText =
      "out of memory: a driver's or a library's memory lies in a file that cannot grow; "
      "is there a limit on the size of files (ulimit -f)?\n";
  // In a handler of signals, only calls of the operating system are safe.
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kText.data(), kText.size());
  _exit(static_cast<int>(ExitCode::Device));
}

}  // namespace

int runProgram(CLI::App& program, int argc, char** argv) {
  // Exceeding a file size limit must fail the write, as a full disk does, instead of ending the process.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGBUS, endWithoutMemory);
  program.footer(kExitCodeHelp);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return endOf(program, program.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::Usage));
  } catch (const std::exception& error) {
    const bool full = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
    std::cout.flush();
    std::cerr << program.get_name() << ": " << (full ? "out of memory: use smaller or fewer frames" : error.what())
              << '\n';
    return static_cast<int>(exitCode(error));
  }
  return endOf(program, 0);
}

}  // namespace walr
