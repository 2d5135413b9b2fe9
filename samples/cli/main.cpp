#include <csignal>
#include <iostream>

#include <CLI/CLI.hpp>

#include "samples/cli/command.h"
#include "samples/cli/exit_code.h"

int main(int argc, char** argv) {
  // A file size limit shall be an error of the write like a full disk, not the end of the process.
  std::signal(SIGXFSZ, SIG_IGN);

  CLI::App program("walr: real-time denoising of 1-sample-per-pixel diffuse indirect light", "walr");
  program.set_version_flag("--version", WALR_VERSION);
  program.require_subcommand(1);
  program.footer(walr::kExitCodeHelp);
  for (const walr::RegisterCommand registerCommand : walr::kCommands) {
    registerCommand(program);
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : static_cast<int>(walr::ExitCode::Usage);
  } catch (const std::exception& error) {
    std::cout.flush();
    std::cerr << "walr: " << error.what() << '\n';
    return static_cast<int>(walr::exitCode(error));
  }
  return 0;
}
