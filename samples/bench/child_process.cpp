#include "samples/bench/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

namespace walr {
namespace {

/// Redirections of a program's output and input, for `posix_spawnp`.
class FileActions {
 public:
  FileActions() {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }

  void printTo(int file) {
    posix_spawn_file_actions_adddup2(&actions_, file, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, file, STDERR_FILENO);
  }
  [[nodiscard]] const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

std::string readToEnd(int file) {
  std::string text;
  std::array<char, 4096> buffer{};
  for (ssize_t size = 0; (size = read(file, buffer.data(), buffer.size())) > 0;) {
    text.append(buffer.data(), static_cast<std::size_t>(size));
  }
  return text;
}

}  // namespace

ChildResult runChild(std::vector<std::string> arguments, ChildOutput output) {
  std::vector<char*> list;
  for (std::string& argument : arguments) list.push_back(argument.data());
  list.push_back(nullptr);

  FileActions actions;
  std::array<int, 2> ends{-1, -1};
  if (output == ChildOutput::Captured) {
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return {};
    actions.printTo(ends[1]);
  }
  pid_t process = 0;
  const bool started = posix_spawnp(&process, list[0], actions.get(), nullptr, list.data(), environ) == 0;
  ChildResult result;
  if (output == ChildOutput::Captured) {
    close(ends[1]);
    if (started) result.output = readToEnd(ends[0]);
    close(ends[0]);
  }
  int status = 0;
  if (started && waitpid(process, &status, 0) >= 0 && WIFEXITED(status)) result.exitCode = WEXITSTATUS(status);
  return result;
}

}  // namespace walr
