#include "samples/command_line/program.h"

#include <csignal>
#include <iostream>

#include "samples/command_line/exit_code.h"

namespace walr {

int runProgram(CLI::App& program, int argc, char** argv) {
  // Exceeding a file size limit must fail the write, as a full disk does, instead of ending the process.
  std::signal(SIGXFSZ, SIG_IGN);
  program.footer(kExitCodeHelp);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::Usage);
  } catch (const std::exception& error) {
    std::cout.flush();
    std::cerr << program.get_name() << ": " << error.what() << '\n';
    return static_cast<int>(exitCode(error));
  }
  return 0;
}

}  // namespace walr
