#include <algorithm>
#include <cstring>
#include <fstream>
#include <random>
#include <span>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "framegraph/vulkan/pipelines.h"

namespace fg::vk {
namespace {

/// The bytes of a file; none if it cannot be read.
std::vector<char> readFile(const std::filesystem::path& path) {
  std::ostringstream bytes;  // Reading by iterators would throw where the file is a folder.
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  const std::string text = std::move(bytes).str();
  return {text.begin(), text.end()};
}

/// FNV-1a. A file ends with that of the driver's bytes: drivers need not notice damage, and must not be given any
/// (VUID-VkPipelineCacheCreateInfo-initialDataSize-00769).
std::uint64_t hashOf(std::span<const char> bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  return hash;
}

/// The driver's bytes out of those of a file; none where the file is damaged.
std::vector<char> unsealed(std::vector<char> file) {
  std::uint64_t hash = 0;
  if (file.size() < sizeof(hash)) return {};
  const std::size_t size = file.size() - sizeof(hash);
  std::memcpy(&hash, file.data() + size, sizeof(hash));
  file.resize(size);
  return hash == hashOf(file) ? file : std::vector<char>();
}

/// Drivers should refuse what is not theirs, and some crash on it instead.
bool belongsTo(const DeviceContext& device, const std::vector<char>& bytes) {
  VkPipelineCacheHeaderVersionOne header{};
  if (bytes.size() < sizeof(header)) return false;
  std::memcpy(&header, bytes.data(), sizeof(header));
  return header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE && header.headerSize >= sizeof(header) &&
         header.vendorID == device.properties.vendorID && header.deviceID == device.properties.deviceID &&
         std::ranges::equal(header.pipelineCacheUUID, device.properties.pipelineCacheUUID);
}

}  // namespace

PipelineCache::PipelineCache(const DeviceContext& device, std::filesystem::path file)
    : device_(&device), file_(std::move(file)) {
  if (!file_.empty()) loaded_ = unsealed(readFile(file_));
  if (!belongsTo(device, loaded_)) loaded_.clear();
  VkPipelineCacheCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  info.initialDataSize = loaded_.size();
  info.pInitialData = loaded_.data();
  cache_ = create<VkPipelineCache>(device, device.functions.vkCreatePipelineCache, info, "creating a pipeline cache");
}

void PipelineCache::save() {
  if (file_.empty()) return;
  std::size_t size = 0;
  const auto getData = [&](void* data) {
    check(device_->functions.vkGetPipelineCacheData(device_->view.device, cache_.get(), &size, data),
          "reading the pipeline cache");
  };
  getData(nullptr);
  std::vector<char> bytes(size);
  getData(bytes.data());
  // Mesa's software driver writes its whole header, but returns a smaller size (seen with 26.2.6).
  bytes.resize(std::max(size, std::min(bytes.size(), sizeof(VkPipelineCacheHeaderVersionOne))));
  if (bytes == loaded_) return;

  // Programs that write at the same time each have a name of their own, and the last to rename wins.
  std::filesystem::path temporary = file_;
  temporary += "." + std::to_string(std::random_device()()) + ".new";
  const std::uint64_t hash = hashOf(bytes);
  std::ofstream out(temporary, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.write(reinterpret_cast<const char*>(&hash), sizeof(hash));
  out.close();
  std::error_code failed = out ? std::error_code() : std::make_error_code(std::errc::io_error);
  if (!failed) std::filesystem::rename(temporary, file_, failed);
  if (failed) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw std::filesystem::filesystem_error("cannot write the pipeline cache", file_, failed);
  }
  loaded_ = std::move(bytes);
}

}  // namespace fg::vk
