// What a program ends with when a command throws.
#include "samples/command_line/program.h"

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <sys/mman.h>

#include "samples/command_line/exit_code.h"
#include "samples/command_line/shell_word.h"

namespace walr {
namespace {

int endOf(std::function<void()> command, std::string& text) {
  CLI::App program("a program", "name");
  program.callback(std::move(command));
  std::string name = "name";
  char* arguments[] = {name.data(), nullptr};
  testing::internal::CaptureStderr();
  const int code = runProgram(program, 1, arguments);
  text = testing::internal::GetCapturedStderr();
  return code;
}

TEST(Program, EndsWithTheCodeOfADeviceWhenMemoryRunsOut) {
  std::string text;
  EXPECT_EQ(endOf([] { throw std::bad_alloc(); }, text), static_cast<int>(ExitCode::Device));
  EXPECT_NE(text.find("name: out of memory"), std::string::npos) << text;
}

// What a driver's memory does that lies in a file which a limit keeps from growing.
TEST(Program, EndsWithTheCodeOfADeviceWhoseMemoryIsNotThere) {
  const auto touchMissingMemory = [] {
    std::FILE* file = std::tmpfile();
    auto* memory = static_cast<volatile char*>(mmap(nullptr, 1, PROT_READ | PROT_WRITE, MAP_SHARED, fileno(file), 0));
    *memory = 1;
  };
  const auto program = [&] {
    CLI::App app("a program", "name");
    app.callback(touchMissingMemory);
    std::string name = "name";
    char* arguments[] = {name.data(), nullptr};
    return runProgram(app, 1, arguments);
  };
  EXPECT_EXIT(std::exit(program()), testing::ExitedWithCode(static_cast<int>(ExitCode::Device)), "ulimit -f");
}

TEST(Program, EndsWithTheFirstCodeForAnyOtherError) {
  std::string text;
  EXPECT_EQ(endOf([] { throw std::logic_error("a reason"); }, text), static_cast<int>(ExitCode::Internal));
  EXPECT_EQ(text, "name: a reason\n");
}

TEST(ShellWord, IsQuotedOnlyWhereTheShellWouldChangeIt) {
  EXPECT_EQ(shellWord("w=bmfr:paper,blocks.size=4"), "w=bmfr:paper,blocks.size=4");
  EXPECT_EQ(shellWord("my frames"), "'my frames'");
  EXPECT_EQ(shellWord("it's"), "'it'\\''s'");
  EXPECT_EQ(shellWord(""), "''");
}

}  // namespace
}  // namespace walr
