#pragma once

#include <chrono>
#include <cstddef>
#include <ostream>
#include <string>

namespace walr {

/// Minutes and seconds ("2:05"), with hours where there are any ("1:02:05").
std::string formatDuration(std::chrono::seconds duration);

/// Progress of a job of known length: a bar that redraws itself on a terminal, plain lines elsewhere.
class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param terminal  whether the stream is a terminal
  /// @param unit      what is counted, in the singular: "frame"
  Progress(std::ostream& stream, bool terminal, std::string unit, std::size_t total, Clock::time_point start);
  /// Leaves the terminal on a fresh line.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// One more is done.
  void advance(Clock::time_point now);
  /// Write a line of text without disturbing the bar.
  void note(const std::string& line);

 private:
  void draw();

  std::ostream& stream_;
  bool terminal_;
  std::string unit_;
  std::size_t total_;
  std::size_t done_ = 0;
  Clock::time_point start_;
  std::chrono::seconds left_{0};
};

}  // namespace walr
