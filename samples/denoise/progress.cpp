#include "samples/denoise/progress.h"

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

Progress::Progress(std::ostream& stream, bool terminal, std::string unit, std::size_t total, Clock::time_point start)
    : stream_(stream), terminal_(terminal), unit_(std::move(unit)), total_(total), start_(start) {
  if (terminal_) {
    draw();
  }
}

Progress::~Progress() {
  if (terminal_) {
    stream_ << std::endl;
  }
}

void Progress::advance(Clock::time_point now) {
  ++done_;
  const std::chrono::duration<double> elapsed = now - start_;
  const double remaining = elapsed.count() / static_cast<double>(done_) * static_cast<double>(total_ - done_);
  left_ = std::chrono::seconds(std::llround(std::ceil(remaining)));
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
  if (done_ > 0) {
    text << ", " << formatDuration(left_) << " left";
  }
  if (terminal_) {
    constexpr std::size_t kBarWidth = 30;
    const std::size_t filled = kBarWidth * done_ / total_;
    // Return to the start of the line, and clear what a longer text before left behind.
    stream_ << "\r[" << std::string(filled, '#') << std::string(kBarWidth - filled, '.') << "] " << text.str()
            << "\x1b[K" << std::flush;
  } else {
    stream_ << text.str() << std::endl;
  }
}

}  // namespace walr
