#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <ostream>
#include <string>

namespace walr {

/// Minutes and seconds ("2:05"), with hours if the duration has any ("1:02:05").
std::string formatDuration(std::chrono::seconds duration);

/// Progress of a job of known length: a bar on a terminal, plain lines elsewhere. Bar and remaining time follow from
/// the work done; elements may differ in their work.
class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param terminal  whether the stream is a terminal
  /// @param unit      name of an element, in the singular: "frame"
  /// @param work      work of the whole job, in any unit, of which `worked` reports parts; absent: 1 for every element
  Progress(std::ostream& stream, bool terminal, std::string unit, std::size_t total, Clock::time_point start,
           std::optional<double> work = std::nullopt);
  /// Ends the line of the bar on a terminal.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Count one more element as done and, without `work` in the constructor, its work as well.
  void advance(Clock::time_point now);
  /// Count some work as done. Without a terminal, this prints a line if the last one is at least half a minute old.
  void worked(double work, Clock::time_point now);
  /// Remove work that need not be done from the total.
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
  bool sameWork_;  // Every element has the same work.
  double work_;
  double workDone_ = 0.0;
  Clock::time_point start_;
  Clock::time_point drawn_;
  std::chrono::seconds left_{0};
};

}  // namespace walr
