#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

#include "integration/c_api/error.h"

namespace walr::api {

/// Objects behind the handles of the C API. A handle is a number that is never reused, so every handle of a destroyed
/// object is recognized.
template <typename Handle, typename Object>
class HandleTable {
 public:
  explicit HandleTable(const char* kind) : kind_(kind) {}

  /// @param partner handle of an object that may not be used while this one is; null for none
  /// @throws Error for an invalid partner
  Handle add(std::unique_ptr<Object> object, Handle partner = nullptr) {
    auto busy = partner == nullptr ? std::make_shared<std::atomic<bool>>(false) : find(partner)->busy;
    const std::lock_guard lock(mutex_);
    const std::uintptr_t number = next_++;
    entries_.emplace(number, std::make_shared<Entry>(std::move(object), std::move(busy)));
    return reinterpret_cast<Handle>(number);
  }

  /// Run an action on an object, if no other call is using it.
  /// @throws Error for an invalid handle, and while another call is using the object
  template <typename Action>
  void use(Handle handle, Action action) {
    const std::shared_ptr<Entry> entry = find(handle);
    const Use inUse(*this, *entry);
    action(*entry->object);
  }

  /// `use` as the body of a C function.
  template <typename Action>
  WalrResult call(Handle handle, Action action) noexcept {
    return guarded([&] { use(handle, action); });
  }

  /// Destroy an object.
  /// @throws Error as `use` does
  void remove(Handle handle) {
    const std::shared_ptr<Entry> entry = find(handle);
    const Use inUse(*this, *entry);
    {
      const std::lock_guard lock(mutex_);
      entries_.erase(reinterpret_cast<std::uintptr_t>(handle));
    }
    entry->object.reset();
  }

 private:
  struct Entry {
    Entry(std::unique_ptr<Object> given, std::shared_ptr<std::atomic<bool>> ofPartners)
        : object(std::move(given)), busy(std::move(ofPartners)) {}
    std::unique_ptr<Object> object;           ///< Null once destroyed.
    std::shared_ptr<std::atomic<bool>> busy;  ///< Whether a call is using this object or a partner.
  };

  /// Claims an entry, or throws.
  class Use {
   public:
    Use(const HandleTable& table, Entry& entry) : entry_(&entry) {
      if (entry.busy->exchange(true, std::memory_order_acquire)) table.rejectBusy();
      if (entry.object != nullptr) return;
      entry.busy->store(false, std::memory_order_release);
      table.rejectDead();
    }
    ~Use() { entry_->busy->store(false, std::memory_order_release); }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

   private:
    Entry* entry_;
  };

  std::shared_ptr<Entry> find(Handle handle) {
    if (handle == nullptr) throw Error(WALR_ERROR_INVALID_HANDLE, std::string(kind_) + " is null");
    const std::lock_guard lock(mutex_);
    const auto found = entries_.find(reinterpret_cast<std::uintptr_t>(handle));
    if (found == entries_.end()) rejectDead();
    return found->second;
  }
  [[noreturn]] void rejectDead() const {
    throw Error(WALR_ERROR_INVALID_HANDLE,
                std::string(kind_) + " was destroyed before, or its handle was never created");
  }
  [[noreturn]] void rejectBusy() const {
    throw Error(WALR_ERROR_CONCURRENT_USE,
                std::string(kind_) +
                    " is in use: wait until the other thread's call returns, and do not call it from a log callback");
  }

  const char* kind_;
  std::mutex mutex_;
  std::uintptr_t next_ = 1;
  std::unordered_map<std::uintptr_t, std::shared_ptr<Entry>> entries_;
};

}  // namespace walr::api
