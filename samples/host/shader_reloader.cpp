#include "samples/host/shader_reloader.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <stdexcept>
#include <variant>

#include "framegraph/tools/reflect.h"
#include "samples/command_line/shell_word.h"

namespace walr::host {
namespace {

struct Run {
  bool succeeded = false;
  std::string output;
};

Run runCommand(const std::string& command) {
  FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot start the shader compiler");
  Run run;
  std::array<char, 4096> buffer{};
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
    run.output.append(buffer.data(), count);
  }
  const int status = pclose(pipe);
  run.succeeded = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return run;
}

std::vector<std::uint32_t> readWords(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
  std::memcpy(words.data(), bytes.data(), words.size() * sizeof(std::uint32_t));
  return words;
}

/// Whether the program can use the code in place of the shader that it was built with.
bool hasInterface(const fg::Shader& shader, const fg::tools::Reflection& code) {
  const auto sameBinding = [](const fg::ShaderBinding& a, const fg::tools::ReflectedBinding& b) {
    return a.name == b.name && a.binding == b.binding && a.type == b.type && a.reads == b.reads &&
           a.writes == b.writes && a.format == b.format && a.blockSize == b.blockSize;
  };
  const auto sameConstant = [](const fg::ShaderConstant& a, const fg::tools::ReflectedConstant& b) {
    return a.name == b.name && a.id == b.id;
  };
  return std::ranges::equal(shader.bindings, code.bindings, sameBinding) &&
         std::ranges::equal(shader.constants, code.constants, sameConstant) &&
         shader.pushConstantSize == code.pushConstantSize && std::ranges::equal(shader.localSize, code.localSize);
}

bool isSource(const std::filesystem::path& path) {
  const auto extension = path.extension();
  return extension == ".comp" || extension == ".glsl" || extension == ".h";
}

std::set<const fg::Shader*> shadersOf(const fg::GraphDesc& graph) {
  std::set<const fg::Shader*> shaders;
  for (const fg::PassDecl& pass : graph.passes) {
    const auto* work = std::get_if<fg::ComputeDispatch>(&pass.work);
    if (work == nullptr) continue;
    shaders.insert(work->shader);
    if (work->shader->inHalves != nullptr) shaders.insert(work->shader->inHalves);
  }
  return shaders;
}

}  // namespace

ShaderReloader::ShaderReloader(const std::filesystem::path& commands, const std::filesystem::path& built,
                               const std::filesystem::path& sources, std::ostream& messages)
    : sources_(sources),
      messages_(messages),
      output_(std::filesystem::temp_directory_path() / ("walr-reload-" + std::to_string(getpid()) + ".spv")) {
  // A line: name of the shader, its SPIR-V in the build, and the words of the command, all separated by tabs.
  std::ifstream file(commands);
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    std::string name;
    std::string spirv;
    std::getline(fields, name, '\t');
    std::getline(fields, spirv, '\t');
    Command& command = commands_[name];
    command.words = readWords(spirv);
    for (std::string word; std::getline(fields, word, '\t');) {
      const std::size_t folder = word.find(built.string());
      if (folder != std::string::npos) word.replace(folder, built.string().size(), sources.string());
      command.line += shellWord(word) + ' ';
    }
  }
  if (commands_.empty()) {
    throw std::runtime_error("cannot read the commands of shaders from " + commands.string() +
                             ": they are part of the build, which must not be moved or deleted");
  }
  times_ = times();
  if (times_.empty()) throw std::runtime_error("there are no sources of shaders in " + sources.string());
}

ShaderReloader::~ShaderReloader() {
  std::error_code ignored;
  std::filesystem::remove(output_, ignored);
}

ShaderReloader::Times ShaderReloader::times() const {
  Times times;
  std::error_code gone;  // An editor may replace a file at this moment.
  for (const auto& entry : std::filesystem::recursive_directory_iterator(sources_, gone)) {
    if (isSource(entry.path())) times[entry.path()] = entry.last_write_time(gone);
  }
  return times;
}

std::size_t ShaderReloader::poll(const fg::GraphDesc& graph, fg::vk::Executor& executor) {
  Times now = times();
  if (now == times_) return 0;
  times_ = std::move(now);
  std::size_t count = 0;
  for (const fg::Shader* const shader : shadersOf(graph)) {
    const auto command = commands_.find(shader->name);
    if (command != commands_.end() && reload(*shader, command->second, executor)) ++count;
  }
  return count;
}

bool ShaderReloader::reload(const fg::Shader& shader, Command& command, fg::vk::Executor& executor) {
  const std::string name(shader.name);
  const Run run = runCommand(command.line + "-o " + shellWord(output_.string()));
  if (!run.succeeded) {
    messages_ << "shader '" << name << "' does not compile, so that it stays as it is:\n" << run.output;
    return false;
  }
  Words words = readWords(output_);
  if (words == command.words) return false;
  try {
    if (!hasInterface(shader, fg::tools::reflect(words))) {
      messages_ << "shader '" << name << "' has other bindings or constants than the program, so that it stays as it "
                << "is: build the program again\n";
      return false;
    }
    executor.replaceCode(shader, words);
  } catch (const std::runtime_error& error) {
    messages_ << "shader '" << name << "' stays as it is: " << error.what() << '\n';
    return false;
  }
  command.words = std::move(words);
  messages_ << "shader '" << name << "' is reloaded\n";
  return true;
}

}  // namespace walr::host
