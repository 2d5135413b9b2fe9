/* A small Vulkan host in C: a device under the validation layer with synchronization validation, images, and frames
 * that are submitted one by one. It knows nothing of walr. */
#ifndef WALR_TESTS_VULKAN_HOST_H
#define WALR_TESTS_VULKAN_HOST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <vulkan/vulkan.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct Host {
  VkInstance instance;
  VkDebugUtilsMessengerEXT messenger;
  VkPhysicalDevice physical_device;
  VkDevice device;
  uint32_t queue_family;
  VkQueue queue;
  VkPhysicalDeviceFeatures2 features; /* Enabled features. */
  VkPhysicalDeviceVulkan12Features vulkan12;
  VkPhysicalDeviceVulkan13Features vulkan13;
  VkCommandPool command_pool;
  VkFence fence;
  int messages; /* Warnings and errors of the layer so far; each is printed. */
} Host;

/* An image with its own memory and its current state. */
typedef struct HostImage {
  VkImage image;
  VkDeviceMemory memory;
  VkFormat format;
  uint32_t width;
  uint32_t height;
  uint32_t texel_size;
  VkImageUsageFlags usage;
  VkPipelineStageFlags2 stage;
  VkAccessFlags2 access;
  VkImageLayout layout;
} HostImage;

/* Do not move or copy a host after it is opened. If Vulkan fails, the functions end the program with a message. */
void host_open(Host* host);
/* The same, with further extensions: at most 8 of the instance, and any of the device. */
void host_open_with(Host* host, const char* const* instance, uint32_t instance_count, const char* const* device,
                    uint32_t device_count);
/* Returns the number of messages, those at destruction included. */
int host_close(Host* host);

/* Allocate memory of the first allowed type with the properties. */
VkDeviceMemory host_allocate(Host* host, VkMemoryRequirements needs, VkMemoryPropertyFlags properties);

/* A buffer with memory of its own. */
typedef struct HostBuffer {
  VkBuffer buffer;
  VkDeviceMemory memory;
  VkDeviceSize bytes; /* Of device memory. */
} HostBuffer;
HostBuffer host_make_buffer(Host* host, VkDeviceSize size, VkBufferUsageFlags usage, VkMemoryPropertyFlags properties);
void host_destroy_buffer(Host* host, HostBuffer* buffer);

/* Usage flags for copies in both directions are added. */
HostImage host_make_image(Host* host, VkFormat format, uint32_t width, uint32_t height, VkImageUsageFlags usage);
void host_destroy_image(Host* host, HostImage* image);
/* Bytes of device memory that the driver requires for the image. */
VkDeviceSize host_image_bytes(Host* host, const HostImage* image);

VkCommandBuffer host_begin(Host* host);
void host_submit_and_wait(Host* host, VkCommandBuffer command_buffer);
/* The same, but wait for a value of a timeline semaphore before and signal another after. */
void host_submit_between(Host* host, VkCommandBuffer command_buffer, VkSemaphore timeline, uint64_t before,
                         uint64_t after);

/* Let the queue raise a timeline semaphore to a value after everything submitted so far, and wait for that. */
void host_signal(Host* host, VkSemaphore timeline, uint64_t value);

/* Record a barrier that brings an image into a state. */
void host_transition(VkCommandBuffer command_buffer, HostImage* image, VkPipelineStageFlags2 stage,
                     VkAccessFlags2 access, VkImageLayout layout);
/* Replace all texels, rows without padding. */
void host_upload(Host* host, HostImage* image, const void* texels);
void host_download(Host* host, HostImage* image, void* texels);

#ifdef __cplusplus
}
#endif
#endif
