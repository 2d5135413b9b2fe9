// A host in C++17: denoises the frames of a sequence in walr's own layout and writes the light as `walr denoise` does.
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <vulkan/vulkan_raii.hpp>
#include <walr/walr.hpp>

namespace {

namespace fs = std::filesystem;
using Access = vk::AccessFlagBits;
using Usage = vk::ImageUsageFlagBits;
using Stage = vk::PipelineStageFlagBits;
constexpr auto kLayout = vk::ImageLayout::eGeneral;
constexpr auto kCopied = vk::BufferUsageFlagBits::eTransferSrc | vk::BufferUsageFlagBits::eTransferDst;
constexpr auto kMapped = vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;

vk::raii::Device makeDevice(const vk::raii::PhysicalDevice& physical) {
  const float priority = 1.0F;
  const vk::DeviceQueueCreateInfo queue({}, 0, 1, &priority);  // Family 0 supports compute on most devices.
  vk::PhysicalDeviceVulkan13Features vulkan13;
  vulkan13.synchronization2 = VK_TRUE;
  vk::PhysicalDeviceFeatures features;
  features.shaderStorageImageExtendedFormats = VK_TRUE;
  return {physical, vk::DeviceCreateInfo({}, queue, {}, {}, &features, &vulkan13)};
}

/// A device with one queue.
struct Gpu {
  vk::raii::Context context;
  vk::ApplicationInfo application{nullptr, 0, nullptr, 0, VK_API_VERSION_1_3};
  vk::raii::Instance instance{context, vk::InstanceCreateInfo({}, &application)};
  vk::raii::PhysicalDevice physical{std::move(vk::raii::PhysicalDevices(instance).at(0))};
  vk::raii::Device device = makeDevice(physical);
  vk::raii::Queue queue{device, 0, 0};
  vk::raii::CommandPool pool{device, {vk::CommandPoolCreateFlagBits::eResetCommandBuffer, 0}};
  vk::raii::CommandBuffer commands{
      std::move(vk::raii::CommandBuffers(device, {*pool, vk::CommandBufferLevel::ePrimary, 1}).front())};
  vk::raii::DeviceMemory allocate(const vk::MemoryRequirements& needs, vk::MemoryPropertyFlags properties) const {
    const auto types = physical.getMemoryProperties().memoryTypes;
    std::uint32_t type = 0;
    while ((needs.memoryTypeBits >> type & 1U) == 0 || (types[type].propertyFlags & properties) != properties) ++type;
    return {device, vk::MemoryAllocateInfo(needs.size, type)};
  }
};

/// One of the host's images, with a buffer in which the processor reads or writes its texels.
struct Picture {
  std::vector<const char*> channels;  ///< Of a file, in the order of the texels' components.
  WalrImageRequirements needs;
  vk::raii::Image image = nullptr;
  vk::raii::Buffer buffer = nullptr;
  vk::raii::DeviceMemory memory = nullptr, staging = nullptr;
  WalrImage described;
  std::size_t texelBytes;
  char* texels;
  Picture(const Gpu& gpu, const walr::cpp::Denoiser& denoiser, const char* name, std::vector<const char*> names)
      : channels(names), needs(denoiser.imageRequirements(name)), texelBytes(names.size() == 1 ? 4 : 8) {
    const auto usage = vk::ImageUsageFlags(needs.usage) | Usage::eTransferSrc | Usage::eTransferDst;
    const vk::Extent3D extent(needs.width, needs.height, 1);
    image = {gpu.device, vk::ImageCreateInfo({}, vk::ImageType::e2D, vk::Format(needs.format), extent, 1, 1,
                                             vk::SampleCountFlagBits::e1, vk::ImageTiling::eOptimal, usage)};
    memory = gpu.allocate(image.getMemoryRequirements(), {});
    image.bindMemory(*memory, 0);
    const std::size_t bytes = texelBytes * needs.width * needs.height;
    buffer = {gpu.device, vk::BufferCreateInfo({}, bytes, kCopied)};
    staging = gpu.allocate(buffer.getMemoryRequirements(), kMapped);
    buffer.bindMemory(*staging, 0);
    texels = static_cast<char*>(std::memset(staging.mapMemory(0, bytes), 0, bytes));
    described = walr::cpp::describe(*image, needs);
  }
  vk::BufferImageCopy whole() const {
    return {0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {}, {needs.width, needs.height, 1}};
  }
  void upload(const vk::raii::CommandBuffer& commands) {
    const vk::ImageMemoryBarrier overwritten({}, Access::eTransferWrite, {}, kLayout, 0, 0, *image,
                                             {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1});
    commands.pipelineBarrier(Stage::eTransfer, Stage::eTransfer, {}, {}, {}, overwritten);
    commands.copyBufferToImage(*buffer, *image, kLayout, whole());
    described.acquire = {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_IMAGE_LAYOUT_GENERAL, 0};
  }
  void download(const vk::raii::CommandBuffer& commands) const {
    commands.copyImageToBuffer(*image, kLayout, *buffer, whole());
    const vk::MemoryBarrier read(Access::eTransferWrite, Access::eHostRead);
    commands.pipelineBarrier(Stage::eTransfer, Stage::eHost, {}, read, {}, {});
  }
  void addTo(Imf::FrameBuffer& buffer) const {
    const Imf::PixelType type = channels.size() == 1 ? Imf::FLOAT : Imf::HALF;
    for (std::size_t i = 0; i < channels.size(); ++i) {
      buffer.insert(channels[i], Imf::Slice(type, texels + 2 * i, texelBytes, texelBytes * needs.width));
    }
  }
  void write(const fs::path& path) const {
    Imf::Header header(int(needs.width), int(needs.height));
    for (const char* channel : channels) header.channels().insert(channel, Imf::Channel());
    Imf::OutputFile file(path.c_str(), header);
    Imf::FrameBuffer buffer;
    addTo(buffer);
    file.setFrameBuffer(buffer);
    file.writePixels(int(needs.height));
  }
};

/// The frames of a sequence by number.
std::map<int, fs::path> framesIn(const fs::path& folder) {
  std::map<int, fs::path> frames;
  for (const fs::directory_entry& file : fs::directory_iterator(folder)) {
    const std::string stem = file.path().stem().string();
    const std::size_t digits = stem.find_last_not_of("0123456789") + 1;
    const bool frame = digits < stem.size() && stem.rfind("ref", 0) != 0 && file.path().extension() == ".exr";
    if (frame) frames[std::stoi(stem.substr(digits))] = file.path();
  }
  if (frames.empty()) throw std::runtime_error(folder.string() + " holds no frames");
  return frames;
}

/// A matrix in a file's header. Imath's rows for row vectors are walr's columns for column vectors.
void readMatrix(const Imf::Header& header, const char* name, float (&target)[16]) {
  std::memcpy(target, header.typedAttribute<Imf::M44fAttribute>(name).value().getValue(), sizeof(target));
}

void denoise(const fs::path& in, const fs::path& out) {
  const std::map<int, fs::path> frames = framesIn(in);
  const Imath::Box2i window = Imf::InputFile(frames.begin()->second.c_str()).header().dataWindow();
  const Gpu gpu;
  auto device = walr::cpp::make<WalrDevice>();
  device.instance = *gpu.instance, device.physical_device = *gpu.physical, device.device = *gpu.device;
  device.get_instance_proc_addr = gpu.context.getDispatcher()->vkGetInstanceProcAddr;
  auto conventions = walr::cpp::make<WalrConventions>();
  conventions.motion_jittered = VK_TRUE;  // Of sequences; samples/docs/sequences.md has the others, which are walr's.
  auto info = walr::cpp::make<WalrDenoiserInfo>();
  info.device = &device, info.conventions = &conventions;
  info.width = std::uint32_t(window.max.x + 1), info.height = std::uint32_t(window.max.y + 1);
  walr::cpp::Denoiser denoiser(info);
  Picture lighting(gpu, denoiser, "lighting", {"Indirect.R", "Indirect.G", "Indirect.B"});
  Picture depth(gpu, denoiser, "depth", {"Depth.Z"});
  Picture normal(gpu, denoiser, "normal", {"Normal.X", "Normal.Y", "Normal.Z"});
  Picture motion(gpu, denoiser, "motion", {"Motion.X", "Motion.Y", "Motion.Z"});
  Picture albedo(gpu, denoiser, "albedo", {"Albedo.R", "Albedo.G", "Albedo.B"});
  const Picture denoised(gpu, denoiser, "denoised", lighting.channels);
  const auto inputs = {&lighting, &depth, &normal, &motion, &albedo};
  WalrCamera last{};
  for (const auto& [number, path] : frames) {
    Imf::InputFile file(path.c_str());
    Imf::FrameBuffer channels;
    for (const Picture* picture : inputs) picture->addTo(channels);
    file.setFrameBuffer(channels);
    file.readPixels(window.min.y, window.max.y);
    const Imf::Header& header = file.header();
    WalrCamera camera{};
    readMatrix(header, "worldToCamera", camera.view);
    readMatrix(header, "cameraToClip", camera.projection);
    const auto* jitter = header.findTypedAttribute<Imf::V2fAttribute>("jitter");
    if (jitter != nullptr) std::memcpy(camera.jitter, jitter->value().getValue(), sizeof(camera.jitter));
    WalrCamera previous = number == frames.begin()->first ? camera : last;
    readMatrix(header, "previousWorldToCamera", previous.view);
    const auto* cut = header.findTypedAttribute<Imf::IntAttribute>("cameraCut");
    gpu.commands.begin({});
    for (Picture* picture : inputs) picture->upload(gpu.commands);
    auto frame = walr::cpp::make<WalrFrame>();
    frame.flags = WALR_FRAME_INDEX_GIVEN | (cut != nullptr && cut->value() != 0 ? WALR_FRAME_RESET_HISTORY : 0U);
    frame.frame_index = std::uint32_t(number);
    frame.lighting = &lighting.described, frame.depth = &depth.described, frame.normal = &normal.described;
    frame.motion = &motion.described, frame.albedo = &albedo.described, frame.denoised = &denoised.described;
    frame.camera = &camera, frame.previous_camera = &previous;
    denoiser.record(*gpu.commands, frame);
    denoised.download(gpu.commands);
    gpu.commands.end();
    gpu.queue.submit(vk::SubmitInfo({}, {}, *gpu.commands));
    gpu.queue.waitIdle();
    last = camera;
    const std::string name = path.filename().string();
    denoised.write(out / ("denoised" + name.substr(name.find_last_of('_'))));
  }
}

}  // namespace

int main(int count, char** arguments) try {
  if (count != 3) throw std::runtime_error("usage: walr-sequence IN OUT");
  fs::create_directories(arguments[2]);
  denoise(arguments[1], arguments[2]);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
