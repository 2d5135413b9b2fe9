#pragma once

#include <cstdint>
#include <initializer_list>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <walr/walr.h>

namespace walr::test {

/// Random choices that a seed repeats on every platform.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}

  [[nodiscard]] std::uint32_t below(std::size_t count) { return static_cast<std::uint32_t>(random_() % count); }
  [[nodiscard]] bool oneIn(std::uint32_t count) { return below(count) == 0; }
  template <typename T>
  [[nodiscard]] T of(std::initializer_list<T> choices) {
    return choices.begin()[below(choices.size())];
  }

 private:
  std::mt19937_64 random_;
};

/// What a call with random arguments may return.
class Expectation {
 public:
  /// The call must fail.
  void fails() { fails(WALR_SUCCESS); }
  /// The call must fail with a code. If there are further reasons to fail, any of their codes will do. Only an invalid
  /// handle is always found first.
  void fails(WalrResult code) {
    if (mayPass_) code_ = code;
    if (code_ != code && code_ != WALR_ERROR_INVALID_HANDLE) code_ = WALR_SUCCESS;
    mayPass_ = false;
  }
  /// The call may fail: the arguments are valid one by one and perhaps not together.
  void mayFail() { mayFail_ = true; }
  /// The call allocates with an allocator that fails now and then.
  void mayRunOutOfMemory() { mayRunOutOfMemory_ = true; }
  /// Another thread may use or destroy the object at the same time.
  void isShared() { shared_ = true; }

  [[nodiscard]] bool allows(WalrResult result) const {
    if (result == WALR_ERROR_INTERNAL || result == WALR_ERROR_DEVICE_LOST) return false;
    if (result == WALR_ERROR_OUT_OF_MEMORY) return mayRunOutOfMemory_;
    if (shared_) return true;
    if (result == WALR_ERROR_CONCURRENT_USE) return false;
    if (result == WALR_SUCCESS) return mayPass_;
    if (mayPass_) return mayFail_ && result != WALR_ERROR_INVALID_HANDLE;
    return code_ == WALR_SUCCESS || result == code_ || (mayFail_ && code_ != WALR_ERROR_INVALID_HANDLE);
  }

 private:
  bool mayPass_ = true;
  bool mayFail_ = false;
  bool mayRunOutOfMemory_ = false;
  bool shared_ = false;
  WalrResult code_ = WALR_SUCCESS;  ///< Of a failure; success means any.
};

/// Checks the results and error texts of a sequence of calls, and remembers the calls for the report of a fault.
class CallCheck {
 public:
  /// Makes a call and checks its result.
  /// @param names words for the call's arguments; the text of an error must hold one of them
  template <typename Call>
  WalrResult operator()(std::string_view function, const Expectation& expected,
                        const std::vector<std::string_view>& names, Call call) {
    leaveMark();
    const WalrResult result = call();
    judge(function, expected, names, result);
    return result;
  }

  void fault(const std::string& what) { faults_.push_back(what + history()); }

  [[nodiscard]] const std::vector<std::string>& faults() const { return faults_; }
  [[nodiscard]] std::uint64_t calls() const { return calls_; }
  [[nodiscard]] std::uint64_t failures() const { return failures_; }

 private:
  /// Leaves a known text as the thread's last error, so that a call that fails without a text of its own is noticed.
  static void leaveMark();
  void judge(std::string_view function, const Expectation& expected, const std::vector<std::string_view>& names,
             WalrResult result);
  [[nodiscard]] std::string history() const;

  std::vector<std::string> log_;
  std::vector<std::string> faults_;
  std::uint64_t calls_ = 0;
  std::uint64_t failures_ = 0;
};

}  // namespace walr::test
