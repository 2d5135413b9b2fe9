#define _POSIX_C_SOURCE 200112L  // setenv
#include "vulkan_host.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#define setenv(name, value, overwrite) _putenv_s((name), (value))
#endif

static void check(VkResult result, const char* what) {
  if (result == VK_SUCCESS) return;
  fprintf(stderr, "%s: VkResult %d\n", what, (int)result);
  exit(1);
}

static VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                 VkDebugUtilsMessageTypeFlagsEXT type,
                                                 const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  (void)severity;
  (void)type;
  // Drivers and loaders cause this one themselves (KhronosGroup/Vulkan-ValidationLayers, issue 8048).
  const char* const query_of_driver = "WARNING-vkGetDeviceProcAddr-device";
  if (data->pMessageIdName != NULL && strcmp(data->pMessageIdName, query_of_driver) == 0) return VK_FALSE;
  Host* host = user;
  ++host->messages;
  fprintf(stderr, "validation: %s\n", data->pMessage);
  return VK_FALSE;
}

enum { kMostExtensions = 8 };

static void open_instance(Host* host, const char* const* more, uint32_t count) {
  // Newer versions of the layer leave out what shaders access unless they are told otherwise.
  setenv("VK_LAYER_SYNCVAL_SHADER_ACCESSES_HEURISTIC", "true", 1);
  // They also leave out the eleventh message of a kind and all after it.
  setenv("VK_LAYER_ENABLE_MESSAGE_LIMIT", "false", 1);
  const VkValidationFeatureEnableEXT enabled[] = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  const VkDebugUtilsMessengerCreateInfoEXT messenger = {
      .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
      .messageSeverity =
          VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
      .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
      .pfnUserCallback = on_message,
      .pUserData = host};
  const VkValidationFeaturesEXT validation = {.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                              .pNext = &messenger,
                                              .enabledValidationFeatureCount = 1,
                                              .pEnabledValidationFeatures = enabled};
  const VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .apiVersion = VK_API_VERSION_1_3};
  const char* const layers[] = {"VK_LAYER_KHRONOS_validation"};
  // Wine shows programs no layers, so none can be named. There, Linux' loader adds the layer (tests/windows). Without
  // the layer, creation fails in either case, because its extension is missing.
  uint32_t layer_count = 0;
  check(vkEnumerateInstanceLayerProperties(&layer_count, NULL), "looking for layers");
  const char* extensions[kMostExtensions + 2] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME,
                                                 VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
  for (uint32_t i = 0; i < count && i < kMostExtensions; ++i) extensions[i + 2] = more[i];
  const VkInstanceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                     .pNext = &validation,
                                     .pApplicationInfo = &application,
                                     .enabledLayerCount = layer_count > 0 ? 1 : 0,
                                     .ppEnabledLayerNames = layers,
                                     .enabledExtensionCount = count + 2,
                                     .ppEnabledExtensionNames = extensions};
  check(vkCreateInstance(&info, NULL, &host->instance), "creating an instance with the validation layer");
  const PFN_vkCreateDebugUtilsMessengerEXT create =
      (PFN_vkCreateDebugUtilsMessengerEXT)vkGetInstanceProcAddr(host->instance, "vkCreateDebugUtilsMessengerEXT");
  check(create(host->instance, &messenger, NULL, &host->messenger), "creating a messenger");
}

static void open_device(Host* host, const char* const* extensions, uint32_t extension_count) {
  uint32_t count = 1;
  const VkResult found = vkEnumeratePhysicalDevices(host->instance, &count, &host->physical_device);
  if (found != VK_INCOMPLETE) check(found, "looking for a device");
  VkQueueFamilyProperties families[16];
  count = 16;
  vkGetPhysicalDeviceQueueFamilyProperties(host->physical_device, &count, families);
  while (host->queue_family < count && (families[host->queue_family].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0) {
    ++host->queue_family;
  }
  const float priority = 1.0F;
  const VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                         .queueFamilyIndex = host->queue_family,
                                         .queueCount = 1,
                                         .pQueuePriorities = &priority};
  host->vulkan13 = (VkPhysicalDeviceVulkan13Features){.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES,
                                                      .synchronization2 = VK_TRUE};
  /* libplacebo needs timeline semaphores and query resets. */
  host->vulkan12 = (VkPhysicalDeviceVulkan12Features){.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
                                                      .pNext = &host->vulkan13,
                                                      .hostQueryReset = VK_TRUE,
                                                      .timelineSemaphore = VK_TRUE};
  host->features = (VkPhysicalDeviceFeatures2){.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2,
                                               .pNext = &host->vulkan12,
                                               .features = {.shaderStorageImageExtendedFormats = VK_TRUE}};
  const VkDeviceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                   .pNext = &host->features,
                                   .queueCreateInfoCount = 1,
                                   .pQueueCreateInfos = &queue,
                                   .enabledExtensionCount = extension_count,
                                   .ppEnabledExtensionNames = extensions};
  check(vkCreateDevice(host->physical_device, &info, NULL, &host->device), "creating a device");
  vkGetDeviceQueue(host->device, host->queue_family, 0, &host->queue);
}

void host_open(Host* host) {
  host_open_with(host, NULL, 0, NULL, 0);
}

void host_open_with(Host* host, const char* const* instance, uint32_t instance_count, const char* const* device,
                    uint32_t device_count) {
  memset(host, 0, sizeof(*host));
  open_instance(host, instance, instance_count);
  open_device(host, device, device_count);
  const VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                        .queueFamilyIndex = host->queue_family};
  check(vkCreateCommandPool(host->device, &pool, NULL, &host->command_pool), "creating a command pool");
  const VkFenceCreateInfo fence = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  check(vkCreateFence(host->device, &fence, NULL, &host->fence), "creating a fence");
}

int host_close(Host* host) {
  vkDestroyFence(host->device, host->fence, NULL);
  vkDestroyCommandPool(host->device, host->command_pool, NULL);
  vkDestroyDevice(host->device, NULL);
  const PFN_vkDestroyDebugUtilsMessengerEXT destroy =
      (PFN_vkDestroyDebugUtilsMessengerEXT)vkGetInstanceProcAddr(host->instance, "vkDestroyDebugUtilsMessengerEXT");
  destroy(host->instance, host->messenger, NULL);
  vkDestroyInstance(host->instance, NULL);
  return host->messages;
}

VkDeviceMemory host_allocate(Host* host, VkMemoryRequirements needs, VkMemoryPropertyFlags properties) {
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(host->physical_device, &memory);
  for (uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
    if ((needs.memoryTypeBits >> type & 1U) == 0) continue;
    if ((memory.memoryTypes[type].propertyFlags & properties) != properties) continue;
    const VkMemoryAllocateInfo info = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = needs.size, .memoryTypeIndex = type};
    VkDeviceMemory result = VK_NULL_HANDLE;
    check(vkAllocateMemory(host->device, &info, NULL, &result), "allocating memory");
    return result;
  }
  check(VK_ERROR_OUT_OF_DEVICE_MEMORY, "finding a memory type");
  return VK_NULL_HANDLE;
}

HostBuffer host_make_buffer(Host* host, VkDeviceSize size, VkBufferUsageFlags usage, VkMemoryPropertyFlags properties) {
  HostBuffer result = {.buffer = VK_NULL_HANDLE};
  const VkBufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = size, .usage = usage};
  check(vkCreateBuffer(host->device, &info, NULL, &result.buffer), "creating a buffer");
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(host->device, result.buffer, &needs);
  result.memory = host_allocate(host, needs, properties);
  result.bytes = needs.size;
  check(vkBindBufferMemory(host->device, result.buffer, result.memory, 0), "binding a buffer's memory");
  return result;
}

void host_destroy_buffer(Host* host, HostBuffer* buffer) {
  vkDestroyBuffer(host->device, buffer->buffer, NULL);
  vkFreeMemory(host->device, buffer->memory, NULL);
  memset(buffer, 0, sizeof(*buffer));
}

/* Bytes of a texel; 0 for other formats, whose texels nobody copies. */
static uint32_t texel_size_of(VkFormat format) {
  switch (format) {
    case VK_FORMAT_R16_UINT:
    case VK_FORMAT_R16_SFLOAT:
      return 2;
    case VK_FORMAT_R32_SFLOAT:
    case VK_FORMAT_R32_UINT:
    case VK_FORMAT_R16G16_SFLOAT:
    case VK_FORMAT_B10G11R11_UFLOAT_PACK32:
      return 4;
    case VK_FORMAT_R16G16B16A16_SFLOAT:
    case VK_FORMAT_R32G32_SFLOAT:
    case VK_FORMAT_R32G32_UINT:
      return 8;
    case VK_FORMAT_R32G32B32A32_SFLOAT:
    case VK_FORMAT_R32G32B32A32_UINT:
      return 16;
    default:
      return 0;
  }
}

HostImage host_make_image(Host* host, VkFormat format, uint32_t width, uint32_t height, VkImageUsageFlags usage) {
  HostImage image = {.format = format,
                     .width = width,
                     .height = height,
                     .texel_size = texel_size_of(format),
                     .usage = usage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT};
  const VkImageCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                  .imageType = VK_IMAGE_TYPE_2D,
                                  .format = format,
                                  .extent = {width, height, 1},
                                  .mipLevels = 1,
                                  .arrayLayers = 1,
                                  .samples = VK_SAMPLE_COUNT_1_BIT,
                                  .tiling = VK_IMAGE_TILING_OPTIMAL,
                                  .usage = image.usage};
  check(vkCreateImage(host->device, &info, NULL, &image.image), "creating an image");
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(host->device, image.image, &needs);
  image.memory = host_allocate(host, needs, 0);
  check(vkBindImageMemory(host->device, image.image, image.memory, 0), "binding an image's memory");
  return image;
}

void host_destroy_image(Host* host, HostImage* image) {
  vkDestroyImage(host->device, image->image, NULL);
  vkFreeMemory(host->device, image->memory, NULL);
  memset(image, 0, sizeof(*image));
}

VkDeviceSize host_image_bytes(Host* host, const HostImage* image) {
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(host->device, image->image, &needs);
  return needs.size;
}

VkCommandBuffer host_begin(Host* host) {
  check(vkResetCommandPool(host->device, host->command_pool, 0), "resetting the command pool");
  const VkCommandBufferAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                            .commandPool = host->command_pool,
                                            .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                            .commandBufferCount = 1};
  VkCommandBuffer command_buffer = VK_NULL_HANDLE;
  check(vkAllocateCommandBuffers(host->device, &info, &command_buffer), "allocating a command buffer");
  const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                          .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
  check(vkBeginCommandBuffer(command_buffer, &begin), "beginning a command buffer");
  return command_buffer;
}

static void submit(Host* host, VkCommandBuffer command_buffer, VkSubmitInfo info) {
  check(vkEndCommandBuffer(command_buffer), "ending a command buffer");
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  info.commandBufferCount = 1;
  info.pCommandBuffers = &command_buffer;
  check(vkQueueSubmit(host->queue, 1, &info, host->fence), "submitting");
  check(vkWaitForFences(host->device, 1, &host->fence, VK_TRUE, UINT64_MAX), "waiting");
  check(vkResetFences(host->device, 1, &host->fence), "resetting a fence");
  vkFreeCommandBuffers(host->device, host->command_pool, 1, &command_buffer);
}

void host_submit_and_wait(Host* host, VkCommandBuffer command_buffer) {
  submit(host, command_buffer, (VkSubmitInfo){0});
}

void host_submit_between(Host* host, VkCommandBuffer command_buffer, VkSemaphore timeline, uint64_t before,
                         uint64_t after) {
  const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
  const VkTimelineSemaphoreSubmitInfo values = {.sType = VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO,
                                                .waitSemaphoreValueCount = 1,
                                                .pWaitSemaphoreValues = &before,
                                                .signalSemaphoreValueCount = 1,
                                                .pSignalSemaphoreValues = &after};
  submit(host, command_buffer,
         (VkSubmitInfo){.pNext = &values,
                        .waitSemaphoreCount = 1,
                        .pWaitSemaphores = &timeline,
                        .pWaitDstStageMask = &stage,
                        .signalSemaphoreCount = 1,
                        .pSignalSemaphores = &timeline});
}

void host_signal(Host* host, VkSemaphore timeline, uint64_t value) {
  const VkTimelineSemaphoreSubmitInfo values = {.sType = VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO,
                                                .signalSemaphoreValueCount = 1,
                                                .pSignalSemaphoreValues = &value};
  const VkSubmitInfo info = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                             .pNext = &values,
                             .signalSemaphoreCount = 1,
                             .pSignalSemaphores = &timeline};
  check(vkQueueSubmit(host->queue, 1, &info, VK_NULL_HANDLE), "submitting a signal");
  const VkSemaphoreWaitInfo wait = {
      .sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO, .semaphoreCount = 1, .pSemaphores = &timeline, .pValues = &value};
  check(vkWaitSemaphores(host->device, &wait, UINT64_MAX), "waiting for a signal");
}

void host_transition(VkCommandBuffer command_buffer, HostImage* image, VkPipelineStageFlags2 stage,
                     VkAccessFlags2 access, VkImageLayout layout) {
  const VkImageMemoryBarrier2 barrier = {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                                         .srcStageMask = image->stage,
                                         .srcAccessMask = image->access,
                                         .dstStageMask = stage,
                                         .dstAccessMask = access,
                                         .oldLayout = image->layout,
                                         .newLayout = layout,
                                         .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                         .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                         .image = image->image,
                                         .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
  const VkDependencyInfo dependency = {
      .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier};
  vkCmdPipelineBarrier2(command_buffer, &dependency);
  image->stage = stage;
  image->access = access;
  image->layout = layout;
}

/* A staging buffer for one copy between host memory and an image. */
static void copy(Host* host, HostImage* image, void* texels, bool to_image) {
  const VkDeviceSize size = (VkDeviceSize)image->width * image->height * image->texel_size;
  HostBuffer staging = host_make_buffer(host, size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  void* mapped = NULL;
  check(vkMapMemory(host->device, staging.memory, 0, VK_WHOLE_SIZE, 0, &mapped), "mapping");
  if (to_image) memcpy(mapped, texels, size);

  const VkCommandBuffer commands = host_begin(host);
  const VkBufferImageCopy region = {.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                    .imageExtent = {image->width, image->height, 1}};
  if (to_image) {
    host_transition(commands, image, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                    VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    vkCmdCopyBufferToImage(commands, staging.buffer, image->image, image->layout, 1, &region);
  } else {
    host_transition(commands, image, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                    VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    vkCmdCopyImageToBuffer(commands, image->image, image->layout, staging.buffer, 1, &region);
  }
  host_submit_and_wait(host, commands);
  if (!to_image) memcpy(texels, mapped, size);
  host_destroy_buffer(host, &staging);
}

void host_upload(Host* host, HostImage* image, const void* texels) {
  copy(host, image, (void*)texels, true);
}

void host_download(Host* host, HostImage* image, void* texels) {
  copy(host, image, texels, false);
}
