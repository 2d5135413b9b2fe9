#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <queue>
#include <utility>

namespace walr {

/// A queue between two threads that holds at most a given number of elements.
template <typename T>
class BoundedQueue {
 public:
  explicit BoundedQueue(std::size_t capacity) : capacity_(capacity) {}

  /// Wait for a free place, then add the element. Once the queue is closed, drops the element and returns false.
  bool push(T element) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || elements_.size() < capacity_; });
    if (closed_) {
      return false;
    }
    elements_.push(std::move(element));
    changed_.notify_all();
    return true;
  }

  /// Wait for an element and take it. Returns nullopt once the queue is closed and empty.
  std::optional<T> pop() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || !elements_.empty(); });
    if (elements_.empty()) {
      return std::nullopt;
    }
    std::optional<T> element(std::move(elements_.front()));
    elements_.pop();
    changed_.notify_all();
    return element;
  }

  /// Accept no more elements. Those in the queue can still be taken.
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }

  /// Close, and drop the elements in the queue.
  void abandon() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    elements_ = {};
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::queue<T> elements_;
  std::size_t capacity_;
  bool closed_ = false;
};

}  // namespace walr
