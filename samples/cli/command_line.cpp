#include "samples/cli/command_line.h"

#include "samples/command_line/shell_word.h"

namespace walr {

std::string commandLine(const CLI::App& program, const CLI::App& command) {
  std::string text = program.get_name() + " " + command.get_name();
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& value : option->results()) {
      text += " --" + option->get_single_name() + (option->get_expected_max() > 0 ? " " + shellWord(value) : "");
    }
  }
  return text;
}

}  // namespace walr
