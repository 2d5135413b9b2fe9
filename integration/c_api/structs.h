#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include <walr/walr_passes.h>

#include "integration/c_api/error.h"

/// Structures that may grow with every version: `struct_size` is the size that the caller knows.
namespace walr::api {

/// Size of a structure in the first version that had it. No caller can know less.
template <typename Struct>
inline constexpr std::uint32_t kLeastSize = sizeof(Struct);
template <>
inline constexpr std::uint32_t kLeastSize<WalrDenoiserInfo> = offsetof(WalrDenoiserInfo, object_id_format);
template <>
inline constexpr std::uint32_t kLeastSize<WalrFrame> = offsetof(WalrFrame, object_id);
template <>
inline constexpr std::uint32_t kLeastSize<WalrConventions> = offsetof(WalrConventions, rectangle);
template <>
inline constexpr std::uint32_t kLeastSize<WalrPassesInfo> = offsetof(WalrPassesInfo, ports);
template <>
inline constexpr std::uint32_t kLeastSize<WalrDevice> = offsetof(WalrDevice, create_info);
template <>
inline constexpr std::uint32_t kLeastSize<WalrPassFrame> = offsetof(WalrPassFrame, offset);

template <>
inline constexpr std::uint32_t kLeastSize<WalrMemory> = offsetof(WalrMemory, shared);

/// Larger than any structure will ever be. A larger `struct_size` is an uninitialized one.
inline constexpr std::uint32_t kMostSize = 1U << 16;

template <typename Struct>
std::uint32_t structSize(const Struct* given, const char* name) {
  if (given == nullptr) throw Error(WALR_ERROR_INVALID_ARGUMENT, std::string(name) + " is null");
  const std::uint32_t size = given->struct_size;
  if (size < kLeastSize<Struct> || size > kMostSize || size % alignof(Struct) != 0) {
    throw Error(WALR_ERROR_STRUCT_SIZE,
                std::string(name) + "::struct_size is " + std::to_string(size) + ": set it to sizeof(" + name + ")");
  }
  return size;
}

/// Copy a structure of the caller. Fields that the caller does not know are zero.
/// @throws Error for null, for a size that was not set, and for nonzero fields that this version does not know
template <typename Struct>
Struct readStruct(const Struct* given, const char* name) {
  const std::uint32_t size = structSize(given, name);
  const std::size_t knownSize = std::min<std::size_t>(size, sizeof(Struct));
  Struct known{};
  std::memcpy(&known, given, knownSize);
  const auto* bytes = reinterpret_cast<const std::byte*>(given);
  bool hasUnknown = std::any_of(bytes + knownSize, bytes + size, [](std::byte b) { return b != std::byte{0}; });
  // A newer header may have a field in place of `reserved`.
  if constexpr (requires { known.reserved; }) hasUnknown = hasUnknown || known.reserved != 0;
  if constexpr (requires { known.reserved2; }) hasUnknown = hasUnknown || known.reserved2 != 0;
  if (hasUnknown) {
    throw Error(WALR_ERROR_STRUCT_SIZE, std::string(name) +
                                            " has fields set that this version of the library does not know: use the "
                                            "header that came with it");
  }
  return known;
}

/// `readStruct` for an optional structure: null gives zeros.
template <typename Struct>
Struct readOptional(const Struct* given, const char* name) {
  return given == nullptr ? Struct{} : readStruct(given, name);
}

/// Write those fields that the caller knows.
template <typename Struct>
void writeStruct(Struct* target, Struct value, const char* name) {
  const std::uint32_t size = structSize(target, name);
  value.struct_size = size;
  std::memcpy(target, &value, std::min<std::size_t>(size, sizeof(Struct)));
}

/// @throws Error if an enumeration holds none of its values
template <typename Enum>
Enum checkedEnum(Enum value, Enum last, const char* name) {
  const auto number = static_cast<std::int64_t>(value);
  if (number >= 0 && number <= static_cast<std::int64_t>(last)) return value;
  throw Error(WALR_ERROR_INVALID_ARGUMENT, std::string(name) + " is " + std::to_string(number) + ", not one of 0.." +
                                               std::to_string(static_cast<std::int64_t>(last)));
}

/// @throws Error if a switch is neither on nor off
inline void checkSwitch(VkBool32 value, const char* name) {
  if (value == VK_FALSE || value == VK_TRUE) return;
  throw Error(WALR_ERROR_INVALID_ARGUMENT,
              std::string(name) + " is " + std::to_string(value) + ", neither VK_FALSE nor VK_TRUE");
}

/// @throws Error if flags other than those of `known` are set
inline void checkFlags(std::uint32_t flags, std::uint32_t known, const char* name) {
  if ((flags & ~known) == 0) return;
  throw Error(WALR_ERROR_INVALID_ARGUMENT, std::string(name) + " has unknown bits: " + std::to_string(flags & ~known));
}

/// @throws Error if a string is null
inline std::string_view requireText(const char* text, const char* name) {
  if (text == nullptr) throw Error(WALR_ERROR_INVALID_ARGUMENT, std::string(name) + " is null");
  return text;
}

/// @throws Error if an address is null
template <typename T>
T& required(T* pointer, const char* name) {
  if (pointer == nullptr) throw Error(WALR_ERROR_INVALID_ARGUMENT, std::string(name) + " is null");
  return *pointer;
}

/// Copy as many elements to the caller as there is room for.
/// @param count in: room at `target`; out: number of elements
template <typename Element, typename Target, typename Convert>
void copyElements(const Element& elements, Target* target, std::uint32_t* count, Convert convert) {
  std::uint32_t& room = required(count, "the count's address");
  const std::size_t written = target == nullptr ? 0 : std::min<std::size_t>(room, elements.size());
  room = static_cast<std::uint32_t>(elements.size());
  std::transform(elements.begin(), elements.begin() + static_cast<std::ptrdiff_t>(written), target, convert);
}

/// Copy bytes to the caller.
/// @param size in: bytes at `target`; out: `count`
/// @throws Error if `target` is too small
inline void copyOut(const void* bytes, std::size_t count, void* target, std::size_t* size) {
  std::size_t& room = required(size, "the size's address");
  const std::size_t given = room;
  room = count;
  if (target == nullptr) return;
  if (given < count) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT,
                "it needs " + std::to_string(count) + " bytes, there are " + std::to_string(given));
  }
  std::memcpy(target, bytes, count);
}

}  // namespace walr::api
