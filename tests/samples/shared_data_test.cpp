// How tests find optional data. No data is needed here: a temporary folder stands in for it.
#include "tests/shared_data.h"

#include <fstream>
#include <optional>

#include "tests/error_text.h"
#include "tests/samples/temporary_directory.h"

namespace walr::test {
namespace {

/// Restores WALR_SHARED afterwards.
class SharedDataFolder : public testing::Test {
 protected:
  SharedDataFolder() {
    if (const char* value = std::getenv("WALR_SHARED")) before = value;
  }
  ~SharedDataFolder() override {
    if (before) {
      setenv("WALR_SHARED", before->c_str(), 1);
    } else {
      unsetenv("WALR_SHARED");
    }
  }

  TemporaryDirectory folder;
  std::optional<std::string> before;
};

TEST_F(SharedDataFolder, IsFoundByTheVariable) {
  std::ofstream(folder.path() / "file");
  setenv("WALR_SHARED", folder.path().c_str(), 1);
  const SharedData file("file");
  EXPECT_TRUE(file);
  EXPECT_EQ(file.path(), folder.path() / "file");
}

TEST_F(SharedDataFolder, IsAskedForWhereItIsMissing) {
  unsetenv("WALR_SHARED");
  EXPECT_FALSE(SharedData("scenes/a.glb"));
  EXPECT_EQ(SharedData("scenes/a.glb").whyNot(), "not run: set WALR_SHARED to the folder that has scenes/a.glb");
  setenv("WALR_SHARED", folder.path().c_str(), 1);
  EXPECT_EQ(SharedData("a.glb").whyNot(),
            "not run: the folder in WALR_SHARED, " + folder.path().string() + ", has no a.glb");
}

TEST_F(SharedDataFolder, ThatDoesNotExistIsAnError) {
  setenv("WALR_SHARED", (folder.path() / "mistyped").c_str(), 1);
  fg::test::expectError<std::runtime_error>([] { SharedData data("a"); },
                                            {"WALR_SHARED is '", "mistyped", "not a folder"});
}

TEST(OptionalData, IsLookedAtOnlyWhereContinuousIntegrationRunsTheTest) {
  fg::test::expectError<std::logic_error>([] { SharedData data("a"); }, {"OptionalData", "must begin with SharedData"});
}

}  // namespace
}  // namespace walr::test
