#include "framegraph/vulkan/messages.h"

#include <utility>

namespace fg::vk {

MessageSink MessageLog::sink() {
  return [this](const Message& message) {
    const std::lock_guard lock(mutex_);
    messages_.push_back(message);
  };
}

std::vector<Message> MessageLog::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(messages_, {});
}

}  // namespace fg::vk
