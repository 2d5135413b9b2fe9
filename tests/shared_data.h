#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace walr::test {

/// A file or folder of the data that some tests look at if it is there: scenes and sequences that are not part of the
/// project. The environment variable WALR_SHARED names their folder. A test without its data is skipped:
///
///     const SharedData scene("scenes/sponza.glb");
///     if (!scene) GTEST_SKIP() << scene.whyNot();
///
/// The names of such test suites begin with SharedData, so that `ctest -R SharedData` runs them all.
class SharedData {
 public:
  explicit SharedData(const std::filesystem::path& relative) {
    const std::string_view suite = testing::UnitTest::GetInstance()->current_test_info()->test_suite_name();
    // The suite's own name follows the name of an instantiation and a slash.
    if (suite.substr(suite.rfind('/') + 1).substr(0, kSuite.size()) != kSuite) {
      throw std::logic_error("the test suite " + std::string(suite) +
                             " looks at shared data, so its name must begin with " + std::string(kSuite));
    }
    const char* folder = std::getenv("WALR_SHARED");
    if (folder == nullptr || *folder == '\0') {
      whyNot_ = "not run: set WALR_SHARED to the folder that has " + relative.string();
      return;
    }
    // A mistyped folder must not look like data that nobody has.
    if (!std::filesystem::is_directory(folder)) {
      throw std::runtime_error("WALR_SHARED is '" + std::string(folder) + "', which is not a folder");
    }
    path_ = std::filesystem::path(folder) / relative;
    if (!std::filesystem::exists(path_)) {
      whyNot_ = "not run: the folder in WALR_SHARED, " + std::string(folder) + ", has no " + relative.string();
    }
  }

  explicit operator bool() const { return whyNot_.empty(); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const std::string& whyNot() const { return whyNot_; }

 private:
  static constexpr std::string_view kSuite = "SharedData";

  std::filesystem::path path_;
  std::string whyNot_;
};

}  // namespace walr::test
