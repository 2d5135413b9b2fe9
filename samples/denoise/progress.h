#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <ostream>
#include <string>

namespace walr {

/// Minutes and seconds ("2:05"), with hours where there are any ("1:02:05").
std::string formatDuration(std::chrono::seconds duration);

/// Progress of a job of known length: a bar that redraws itself on a terminal, plain lines elsewhere. Bar and remaining
/// time go by the work done, which need not be the same for all elements that are counted.
class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param terminal  whether the stream is a terminal
  /// @param unit      what is counted, in the singular: "frame"
  /// @param work      of the whole job, in any unit, for `worked`; absent: every element is one
  Progress(std::ostream& stream, bool terminal, std::string unit, std::size_t total, Clock::time_point start,
           std::optional<double> work = std::nullopt);
  /// Leaves the terminal on a fresh line.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// One more is done. Where every element is the same work, that is done, too.
  void advance(Clock::time_point now);
  /// Some of the work is done. Elsewhere than on a terminal a line says so where the last one is half a minute old.
  void worked(double work, Clock::time_point now);
  /// Some of the work need not be done.
  void skipped(double work) { work_ -= work; }
  /// Write a line of text without disturbing the bar.
  void note(const std::string& line);

 private:
  void draw();
  void count(double work, Clock::time_point now);

  std::ostream& stream_;
  bool terminal_;
  std::string unit_;
  std::size_t total_;
  std::size_t done_ = 0;
  bool sameWork_;  // For every element.
  double work_;
  double workDone_ = 0.0;
  Clock::time_point start_;
  Clock::time_point drawn_;
  std::chrono::seconds left_{0};
};

}  // namespace walr
