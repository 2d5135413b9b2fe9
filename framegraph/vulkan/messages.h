#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace fg::vk {

/// One message of the validation layer.
struct Message {
  enum class Severity { Warning, Error };
  Severity severity = Severity::Error;
  std::string id;    ///< Stable identifier, for instance "SYNC-HAZARD-READ-AFTER-WRITE".
  std::string text;  ///< The whole message.
};

/// Called with each warning and error at once, on the thread of the offending call.
using MessageSink = std::function<void(const Message&)>;

/// Keeps messages for later. Must outlive the instance that uses its sink.
class MessageLog {
 public:
  [[nodiscard]] MessageSink sink();
  /// All messages since the last call.
  std::vector<Message> take();

 private:
  std::mutex mutex_;
  std::vector<Message> messages_;
};

}  // namespace fg::vk
