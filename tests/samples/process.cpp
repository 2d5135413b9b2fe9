#include "tests/samples/process.h"

#include <array>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace walr::test {
namespace {

struct Pipe {
  Pipe() {
    if (pipe(ends.data()) != 0) {
      throw std::runtime_error("cannot make a pipe");
    }
  }
  std::array<int, 2> ends{};
};

std::string readAll(int file) {
  std::string text;
  std::array<char, 4096> buffer{};
  for (ssize_t size = 0; (size = read(file, buffer.data(), buffer.size())) > 0;) {
    text.append(buffer.data(), static_cast<std::size_t>(size));
  }
  close(file);
  return text;
}

[[noreturn]] void becomeProgram(const std::vector<std::string>& arguments, const ProcessOptions& options) {
  for (const auto& [name, value] : options.environment) {
    setenv(name.c_str(), value.c_str(), 1);
  }
  if (options.largestFileBytes) {
    const rlimit limit{*options.largestFileBytes, *options.largestFileBytes};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  if (options.addressSpaceBytes) {
    const rlimit limit{*options.addressSpaceBytes, *options.addressSpaceBytes};
    setrlimit(RLIMIT_AS, &limit);
  }
  std::vector<char*> list;
  for (const std::string& argument : arguments) {
    // execv takes pointers to non-const for historical reasons; it does not write.
    list.push_back(const_cast<char*>(argument.c_str()));
  }
  list.push_back(nullptr);
  execv(list[0], list.data());
  _exit(127);
}

}  // namespace

ProcessResult runProcess(const std::vector<std::string>& arguments, const ProcessOptions& options) {
  const Pipe out;
  const Pipe err;
  const pid_t child = fork();
  if (child < 0) {
    throw std::runtime_error("cannot start a process");
  }
  if (child == 0) {
    dup2(out.ends[1], STDOUT_FILENO);
    dup2(err.ends[1], STDERR_FILENO);
    for (const int end : {out.ends[0], out.ends[1], err.ends[0], err.ends[1]}) {
      close(end);
    }
    becomeProgram(arguments, options);
  }
  close(out.ends[1]);
  close(err.ends[1]);
  ProcessResult result;
  {
    const std::jthread reader([&] { result.out = readAll(out.ends[0]); });
    result.err = readAll(err.ends[0]);
  }
  int status = 0;
  waitpid(child, &status, 0);
  result.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return result;
}

}  // namespace walr::test
