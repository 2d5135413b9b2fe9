#include "samples/bench/vmaf.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <sstream>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "samples/bench/child_process.h"
#include "samples/errors.h"
#include "samples/image/tone_map.h"

namespace walr {
namespace {

/// Escapes the characters that end a value by backslashes: first those of filter options, then those of filter graphs
/// (ffmpeg-filters, "Notes on filtergraph escaping").
std::string escaped(std::string_view value) {
  std::string result(value);
  for (const std::string_view special : {"\\':", "\\'[],;"}) {
    std::string once;
    for (const char c : result) {
      if (special.find(c) != std::string_view::npos) once += '\\';
      once += c;
    }
    result = std::move(once);
  }
  return result;
}

std::string lastLine(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

std::string firstLine(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

/// Runs a filter on two videos.
/// @param inputs  options of ffmpeg that open the test and the reference
ChildResult runFilter(const std::string& ffmpeg, const std::vector<std::string>& inputs, const std::string& filter) {
  std::vector<std::string> arguments = {ffmpeg, "-hide_banner", "-nostdin", "-loglevel", "error"};
  arguments.insert(arguments.end(), inputs.begin(), inputs.end());
  // VMAF uses luma only. Chroma without subsampling allows any image size.
  arguments.insert(arguments.end(),
                   {"-lavfi", "[0:v]format=yuv444p[t];[1:v]format=yuv444p[r];[t][r]" + filter, "-f", "null", "-"});
  return runChild(std::move(arguments), ChildOutput::Captured);
}

/// The filter with the option that selects the model.
/// @param help  ffmpeg's help text on libvmaf
std::string filterWith(const std::string& help, const std::filesystem::path& model) {
  if (model.empty()) return "libvmaf=log_fmt=json";
  // Since libvmaf 2 the option is called `model`, and its value is a list of options.
  std::istringstream lines(help);
  bool list = false;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name;
    std::string type;
    words >> name >> type;
    list = list || (name == "model" && type == "<string>");
  }
  return "libvmaf=log_fmt=json:" +
         (list ? "model=" + escaped("path=" + model.string()) : "model_path=" + escaped(model.string()));
}

/// Options of ffmpeg that read a `Clip`.
std::vector<std::string> clipInput(const std::filesystem::path& file, fg::Extent extent) {
  return {"-f",       "rawvideo",
          "-pix_fmt", "rgb24",
          "-s",       std::to_string(extent.width) + "x" + std::to_string(extent.height),
          "-i",       "file:" + file.string()};
}

}  // namespace

std::optional<VmafTool> VmafTool::find(const std::string& ffmpeg, const std::filesystem::path& model,
                                       std::string& whyNot) {
  const ChildResult help = runChild({ffmpeg, "-hide_banner", "-h", "filter=libvmaf"}, ChildOutput::Captured);
  if (help.exitCode != 0) {
    whyNot = "'" + ffmpeg + "' cannot be run; --ffmpeg can name an ffmpeg with the filter libvmaf";
    return std::nullopt;
  }
  if (help.output.find("libvmaf AVOptions") == std::string::npos) {
    whyNot = "'" + ffmpeg + "' has no filter libvmaf; --ffmpeg can name an ffmpeg that has it";
    return std::nullopt;
  }
  VmafTool tool;
  tool.ffmpeg_ = ffmpeg;
  tool.filter_ = filterWith(help.output, model);
  const std::vector<std::string> grey = {"-f", "lavfi", "-i", "color=gray:size=64x64:duration=0.1"};
  std::vector<std::string> inputs = grey;
  inputs.insert(inputs.end(), grey.begin(), grey.end());
  const ChildResult trial = runFilter(ffmpeg, inputs, tool.filter_);
  if (trial.exitCode != 0) {
    whyNot = "libvmaf of '" + ffmpeg + "' fails: " + lastLine(trial.output) + "; --vmaf-model can name a model file";
    return std::nullopt;
  }
  const std::string version = firstLine(runChild({ffmpeg, "-version"}, ChildOutput::Captured).output);
  tool.description_ = version.substr(0, version.find(" Copyright")) + ", " +
                      (model.empty() ? "its own model" : model.filename().string());
  return tool;
}

std::vector<double> VmafTool::scores(const std::filesystem::path& test, const std::filesystem::path& reference,
                                     fg::Extent extent) const {
  const std::filesystem::path log = test.string() + ".json";
  std::vector<std::string> inputs = clipInput(test, extent);
  std::ranges::copy(clipInput(reference, extent), std::back_inserter(inputs));
  const ChildResult result = runFilter(ffmpeg_, inputs, filter_ + ":log_path=" + escaped(log.string()));
  std::ifstream stream(log);
  const nlohmann::json json = nlohmann::json::parse(stream, nullptr, false);
  stream.close();
  std::error_code ignored;
  std::filesystem::remove(log, ignored);
  if (result.exitCode != 0 || !json.contains("frames")) {
    throw OutputError("VMAF cannot be computed: '" + ffmpeg_ + "' says: " + lastLine(result.output) +
                      ". Choose another one with --ffmpeg, or skip VMAF with --ffmpeg ''");
  }
  std::vector<double> scores;
  for (const nlohmann::json& frame : json["frames"]) scores.push_back(frame.at("metrics").at("vmaf"));
  return scores;
}

Clip::Clip(std::filesystem::path file) : file_(std::move(file)), stream_(file_, std::ios::binary) {
  requireGood();
}

Clip::~Clip() {
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
}

void Clip::append(const Image& picture) {
  std::vector<char> bytes;
  bytes.reserve(picture.values().size());
  for (const float value : picture.values()) {
    bytes.push_back(static_cast<char>(static_cast<std::uint8_t>(std::lround(255.0F * encodeSrgb(value)))));
  }
  stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  requireGood();
}

const std::filesystem::path& Clip::finished() {
  stream_.flush();
  requireGood();
  return file_;
}

void Clip::requireGood() const {
  if (!stream_) {
    throw OutputError("cannot write " + file_.string() + ", which VMAF needs; --ffmpeg '' skips VMAF");
  }
}

}  // namespace walr
