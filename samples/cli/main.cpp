#include <CLI/CLI.hpp>

#include "samples/cli/command.h"
#include "samples/command_line/program.h"

int main(int argc, char** argv) {
  CLI::App program("walr: real-time denoising of diffuse and specular light of 1 sample per pixel", "walr");
  program.set_version_flag("--version", WALR_VERSION);
  program.require_subcommand(1);
  for (const walr::RegisterCommand registerCommand : walr::kCommands) {
    registerCommand(program);
  }
  return walr::runProgram(program, argc, argv);
}
