#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

#include "framegraph/vulkan/pipelines.h"

namespace fg::vk {
namespace {

std::vector<char> readFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
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

[[noreturn]] void cannotWrite(const std::filesystem::path& file) {
  throw std::filesystem::filesystem_error("cannot write the pipeline cache", file,
                                          std::make_error_code(std::errc::io_error));
}

}  // namespace

PipelineCache::PipelineCache(const DeviceContext& device, std::filesystem::path file)
    : device_(&device), file_(std::move(file)) {
  if (!file_.empty()) loaded_ = readFile(file_);
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
  bytes.resize(size);
  if (bytes == loaded_) return;

  std::filesystem::path temporary = file_;
  temporary += ".new";
  std::ofstream out(temporary, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) cannotWrite(temporary);
  std::filesystem::rename(temporary, file_);
  loaded_ = std::move(bytes);
}

}  // namespace fg::vk
