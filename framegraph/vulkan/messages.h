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

/// Takes each warning and error as it comes, from whichever thread makes the offending call.
using MessageSink = std::function<void(const Message&)>;

/// A sink that keeps what it is given. Must outlive the instance that it is passed to.
class MessageLog {
 public:
  [[nodiscard]] MessageSink sink();
  /// Everything since the last call.
  std::vector<Message> take();

 private:
  std::mutex mutex_;
  std::vector<Message> messages_;
};

}  // namespace fg::vk
