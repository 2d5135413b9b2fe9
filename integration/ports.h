#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "framegraph/declare/graph.h"

namespace walr {

/// Something that a pass type reads or writes. Ports of one name are meant for each other: an output called
/// "accumulated" goes into an input called "accumulated". Others may be connected where their formats agree.
struct Port {
  std::string name;
  bool output = false;
  bool optional = false;  ///< May be left unconnected: an output that is then transient, or an input
                          ///< that is not read with the present settings or that the host need not have.
  bool buffer = false;
  VkFormat format = VK_FORMAT_UNDEFINED;  ///< Textures.
  std::vector<VkFormat> otherFormats;     ///< Inputs: what else it takes, because pass types make it, too.
  std::uint64_t size = 0;                 ///< Bytes; buffers.
  std::vector<fg::Access> accesses;       ///< All that the passes do with it, each once.
  VkImageUsageFlags imageUsage = 0;       ///< Usage flags that these add up to.
  VkBufferUsageFlags bufferUsage = 0;
  std::string description;  ///< Empty where the name says it.
};

/// Textures and buffers of one graph by port name.
struct Connections {
  std::map<std::string, fg::Texture, std::less<>> textures;
  std::map<std::string, fg::Buffer, std::less<>> buffers;
};

}  // namespace walr
