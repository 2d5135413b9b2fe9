#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "framegraph/declare/graph.h"

namespace walr {

/// A resource that a pass type reads or writes. Ports with the same name match: connect the output "accumulated" to the
/// input "accumulated". Ports with other names may be connected if their formats agree.
struct Port {
  std::string name;
  bool output = false;
  bool optional = false;  ///< May be left unconnected: an output that is then transient, or an input that is not read
                          ///< with the current settings or that hosts need not have.
  bool buffer = false;
  VkFormat format = VK_FORMAT_UNDEFINED;  ///< Textures.
  std::uint32_t tile = 1;                 ///< Textures: pixels per axis that a texel stands for.
  std::uint64_t size = 0;                 ///< Bytes; buffers.
  std::vector<fg::Access> accesses;       ///< Accesses of all passes, without repetition.
  VkImageUsageFlags imageUsage = 0;       ///< Union of the flags that the accesses need.
  VkBufferUsageFlags bufferUsage = 0;
  std::string description;  ///< May be empty.
};

/// Textures and buffers of one graph by port name.
struct Connections {
  std::map<std::string, fg::Texture, std::less<>> textures;
  std::map<std::string, fg::Buffer, std::less<>> buffers;
};

}  // namespace walr
