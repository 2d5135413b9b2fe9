#include "samples/denoise/progress.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

namespace walr {

std::string formatDuration(std::chrono::seconds duration) {
  const std::chrono::hh_mm_ss parts(duration);
  std::ostringstream text;
  text << std::setfill('0');
  if (parts.hours().count() > 0) {
    text << parts.hours().count() << ':' << std::setw(2);
  }
  text << parts.minutes().count() << ':' << std::setw(2) << parts.seconds().count();
  return text.str();
}

Progress::Progress(std::ostream& stream, bool terminal, std::string unit, std::size_t total, Clock::time_point start,
                   std::optional<double> work)
    : stream_(stream),
      terminal_(terminal),
      unit_(std::move(unit)),
      total_(total),
      sameWork_(!work),
      work_(work.value_or(static_cast<double>(total))),
      start_(start),
      drawn_(start) {
  if (terminal_) {
    draw();
  }
}

Progress::~Progress() {
  if (terminal_) {
    stream_ << std::endl;
  }
}

void Progress::count(double work, Clock::time_point now) {
  workDone_ += work;
  const std::chrono::duration<double> elapsed = now - start_;
  const double remaining = workDone_ > 0.0 ? elapsed.count() / workDone_ * std::max(work_ - workDone_, 0.0) : 0.0;
  left_ = std::chrono::seconds(done_ < total_ ? std::llround(std::ceil(remaining)) : 0);
}

void Progress::advance(Clock::time_point now) {
  ++done_;
  count(sameWork_ ? 1.0 : 0.0, now);
  drawn_ = now;
  draw();
}

void Progress::worked(double work, Clock::time_point now) {
  constexpr std::chrono::seconds kQuiet(30);
  count(work, now);
  if (!terminal_ && now - drawn_ < kQuiet) return;
  drawn_ = now;
  draw();
}

void Progress::note(const std::string& line) {
  if (terminal_) {
    stream_ << "\r\x1b[K";
  }
  stream_ << line << '\n';
  if (terminal_) {
    draw();
  }
}

void Progress::draw() {
  std::ostringstream text;
  text << unit_ << ' ' << done_ << " of " << total_;
  if (workDone_ > 0.0 || done_ > 0) {
    text << ", " << formatDuration(left_) << " left";
  }
  if (terminal_) {
    constexpr std::size_t kBarWidth = 30;
    const double share = work_ > 0.0 ? std::min(workDone_ / work_, 1.0) : 1.0;
    const auto filled = static_cast<std::size_t>(share * kBarWidth);
    // Return to the start of the line, and clear the rest of a longer previous text.
    stream_ << "\r[" << std::string(filled, '#') << std::string(kBarWidth - filled, '.') << "] " << text.str()
            << "\x1b[K" << std::flush;
  } else {
    stream_ << text.str() << std::endl;
  }
}

}  // namespace walr
