// The C++ header over the C API.
#include <walr/walr.hpp>

#include <string>
#include <type_traits>
#include <utility>

#include <gtest/gtest.h>

#include "tests/integration/hosted_run.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::owning_types_test {
namespace {

template <typename T>
inline constexpr bool kMoveOnly = std::is_nothrow_move_constructible_v<T>&& std::is_nothrow_move_assignable_v<T> &&
                                  !std::is_copy_constructible_v<T> && !std::is_copy_assignable_v<T>;
static_assert(kMoveOnly<cpp::Denoiser> && kMoveOnly<cpp::Passes>);

class OwningTypes : public fg::test::GpuTest {
 protected:
  WalrDenoiserInfo info() {
    device_ = hostDevice(device());
    auto info = cpp::make<WalrDenoiserInfo>();
    info.device = &device_;
    info.width = 64;
    info.height = 48;
    return info;
  }
  WalrDevice device_{};
};

/// Result of an action that throws.
template <typename Action>
WalrResult thrown(const Action& action, const std::string& text) {
  try {
    action();
  } catch (const cpp::Error& error) {
    EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    return error.result();
  }
  return WALR_SUCCESS;
}

TEST_F(OwningTypes, DestroyTheirObjectOnceAndMove) {
  WalrDenoiser handle = nullptr;
  {
    cpp::Denoiser first(info());
    handle = first.get();
    cpp::Denoiser second = std::move(first);
    EXPECT_EQ(first.get(), nullptr);  // NOLINT(bugprone-use-after-move)
    cpp::Denoiser third;
    third = std::move(second);
    EXPECT_EQ(third.get(), handle);
    third.prepare();
  }
  EXPECT_EQ(walr_prepare(handle), WALR_ERROR_INVALID_HANDLE);
}

TEST_F(OwningTypes, ThrowTheLastError) {
  WalrDenoiserInfo wrong = info();
  wrong.method = "magic";
  EXPECT_EQ(thrown([&] { const cpp::Denoiser denoiser(wrong); }, "WALR_ERROR_INVALID_ARGUMENT: "),
            WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(thrown([&] { const cpp::Denoiser denoiser(wrong); }, "known methods: walr"), WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(thrown([] { cpp::Denoiser().prepare(); }, "WalrDenoiser is null"), WALR_ERROR_INVALID_HANDLE);
  cpp::Denoiser denoiser(info());
  EXPECT_EQ(thrown([&] { (void)denoiser.memory(); }, "walr_prepare"), WALR_ERROR_WRONG_ORDER);
  EXPECT_EQ(thrown([&] { denoiser.setView("edge"); }, "known views"), WALR_ERROR_INVALID_ARGUMENT);
}

TEST_F(OwningTypes, ReturnWhatTheCFunctionsWrite) {
  const WalrDenoiserInfo described = info();
  cpp::Denoiser denoiser(described);
  EXPECT_EQ(denoiser.setting("blocks.coarse-narrowing"), "0.6");
  denoiser.setSetting("blocks.coarse-narrowing", "0.5");
  EXPECT_EQ(denoiser.setting("blocks.coarse-narrowing"), "0.5");
  denoiser.setSetting("blocks.coarse-narrowing", "0.6");
  const WalrImageRequirements needs = denoiser.imageRequirements("depth");
  EXPECT_EQ(needs.width, 64U);
  const WalrImage image = cpp::describe(VK_NULL_HANDLE, needs);
  EXPECT_EQ(image.struct_size, sizeof(WalrImage));
  EXPECT_EQ(image.format, needs.format);
  EXPECT_EQ(image.usage, needs.usage);
  EXPECT_EQ(image.height, 48U);
  denoiser.prepare();
  EXPECT_EQ(denoiser.memory().allocated, cpp::queryMemory(described).allocated);
  EXPECT_FALSE(denoiser.views().empty());
  denoiser.setView(denoiser.views().front().name);
  EXPECT_EQ(denoiser.imageRequirements("view").required, VK_TRUE);
  denoiser.clearView();
  EXPECT_EQ(denoiser.imageRequirements("view").required, VK_FALSE);
  EXPECT_TRUE(denoiser.timings().empty());
  EXPECT_EQ(cpp::passTypes().size(), walr_pass_type_count());
  EXPECT_NE(cpp::passTypes().front(), nullptr);
}

TEST_F(OwningTypes, ShareObjectsAndAreDestroyedInAnyOrder) {
  WalrDenoiserInfo described = info();
  cpp::Denoiser first(described);
  first.prepare();
  EXPECT_EQ(first.memory().shared, 0U);
  described.shared_with = first.get();
  cpp::Denoiser second(described);
  second.prepare();
  EXPECT_GT(second.memory().shared, 0U);
  EXPECT_EQ(first.memory().shared, second.memory().shared);
  first = cpp::Denoiser();
  EXPECT_EQ(second.memory().shared, 0U);
  second.prepare();
}

TEST_F(OwningTypes, HoldPassesToo) {
  WalrDenoiserInfo described = info();
  described.lint = VK_TRUE;
  auto listed = cpp::make<WalrPassesInfo>();
  listed.denoiser = &described;
  cpp::Passes passes(listed);
  EXPECT_GT(passes.list().pass_count, 0U);
  EXPECT_TRUE(passes.findings().empty());
  EXPECT_TRUE(passes.counters().empty());
  EXPECT_TRUE(passes.timings().empty());
  EXPECT_EQ(thrown([&] { passes.record(0, VK_NULL_HANDLE, {}); }, "walr_begin_frame"), WALR_ERROR_WRONG_ORDER);
  const cpp::Passes none;
  EXPECT_EQ(thrown([&] { passes.continueFrom(none); }, "WalrPasses is null"), WALR_ERROR_INVALID_HANDLE);
}

}  // namespace
}  // namespace walr::test::owning_types_test
