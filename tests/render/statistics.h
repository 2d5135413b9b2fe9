#pragma once

#include <cmath>
#include <cstddef>

namespace walr::render::test {

/// Mean and standard error of independent samples, by Welford's method.
class Statistics {
 public:
  void add(double value) {
    ++count_;
    const double delta = value - mean_;
    mean_ += delta / static_cast<double>(count_);
    squares_ += delta * (value - mean_);
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] double mean() const { return mean_; }
  [[nodiscard]] double variance() const { return squares_ / static_cast<double>(count_ - 1); }
  [[nodiscard]] double standardError() const { return std::sqrt(variance() / static_cast<double>(count_)); }

 private:
  std::size_t count_ = 0;
  double mean_ = 0.0;
  double squares_ = 0.0;
};

/// Tolerance in standard errors: the mean of many samples lies outside plus or minus 4 once in about 15,000 tests.
inline constexpr double kConfidence = 4.0;

}  // namespace walr::render::test
