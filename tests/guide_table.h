#pragma once

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

namespace walr::test {

/// A table of the integration guide that tests generate. It lies between two comments that carry its name.
class GuideTable {
 public:
  /// Throws std::runtime_error if the guide's page at `path` has no place for the table `name`.
  GuideTable(std::string path, const std::string& name) : path_(std::move(path)) {
    std::ifstream file(path_);
    guide_.assign(std::istreambuf_iterator<char>(file), {});
    const std::string begin = "<!-- " + name + ", written by update_guide: begin -->\n\n";
    const std::size_t at = guide_.find(begin);
    begin_ = at + begin.size();
    end_ = at == std::string::npos ? at : guide_.find("\n<!-- " + name + ", written by update_guide: end -->", begin_);
    if (end_ == std::string::npos) throw std::runtime_error(path_ + " has no place for the table '" + name + "'");
  }

  /// The table as the guide has it: all lines, each with its line break.
  std::string text() const { return guide_.substr(begin_, end_ - begin_); }

  /// Whether the table must be written and not compared: the target `update_guide` runs the tests so.
  static bool writing() { return std::getenv("WALR_UPDATE_GUIDE") != nullptr; }

  /// Replaces the table in the guide's file.
  void write(const std::string& table) const {
    std::string guide = guide_;
    guide.replace(begin_, end_ - begin_, table);
    std::ofstream file(path_);
    if (!(file << guide << std::flush)) throw std::runtime_error("cannot write " + path_);
  }

 private:
  std::string path_;
  std::string guide_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
};

}  // namespace walr::test
