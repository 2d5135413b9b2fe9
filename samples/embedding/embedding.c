/* The smallest Vulkan program that denoises. Compiles as C11 and as C++20; links to walr and to the Vulkan loader. */
#include <stdio.h>
#include <stdlib.h>

#include <vulkan/vulkan.h>
#include <walr/walr.h>

enum { kWidth = 640, kHeight = 360, kImages = 6, kFrames = 3 };
static const char* const kNames[kImages] = {"lighting", "depth", "normal", "motion", "albedo", "denoised"};
static VkDeviceMemory memory[kImages];

static void check(int result) { /* Takes a VkResult or a WalrResult. */
  if (result != 0) exit(fprintf(stderr, "error %d: %s\n", result, walr_last_error()));
}

/* Creates an image and clears it. An engine would pass images that it has rendered to. */
static WalrImage make_image(VkDevice device, WalrDenoiser denoiser, int index, VkCommandBuffer commands) {
  WalrImageRequirements needs = {.struct_size = sizeof(needs)};
  check(walr_get_image_requirements(denoiser, kNames[index], &needs)); /* Known before any image is made. */
  VkImageCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                            .imageType = VK_IMAGE_TYPE_2D,
                            .format = needs.format,
                            .extent = {needs.width, needs.height, 1},
                            .mipLevels = 1,
                            .arrayLayers = 1,
                            .samples = VK_SAMPLE_COUNT_1_BIT,
                            .usage = needs.usage | VK_IMAGE_USAGE_TRANSFER_DST_BIT};
  VkImage image;
  check(vkCreateImage(device, &info, NULL, &image));
  VkMemoryRequirements bytes;
  vkGetImageMemoryRequirements(device, image, &bytes);
  VkMemoryAllocateInfo allocation = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = bytes.size};
  while ((bytes.memoryTypeBits >> allocation.memoryTypeIndex & 1) == 0) ++allocation.memoryTypeIndex;
  check(vkAllocateMemory(device, &allocation, NULL, &memory[index]));
  check(vkBindImageMemory(device, image, memory[index], 0));
  VkImageSubresourceRange range = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  VkImageMemoryBarrier made = {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
                               .dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT,
                               .newLayout = VK_IMAGE_LAYOUT_GENERAL,
                               .image = image,
                               .subresourceRange = range};
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, NULL, 0, NULL,
                       1, &made);
  VkClearColorValue grey = {{0.5F, 0.5F, 0.5F, 1.0F}};
  vkCmdClearColorImage(commands, image, VK_IMAGE_LAYOUT_GENERAL, &grey, 1, &range);
  WalrImage result = {.struct_size = sizeof(result),
                      .queue_family = VK_QUEUE_FAMILY_IGNORED,
                      .image = image,
                      .format = info.format,
                      .usage = info.usage,
                      .width = kWidth,
                      .height = kHeight,
                      .acquire = {VK_PIPELINE_STAGE_2_CLEAR_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, /* The last write. */
                                  VK_IMAGE_LAYOUT_GENERAL, 0}};
  return result;
}

int main(void) {
  /* The engine's device: Vulkan 1.3, or 1.1 with VK_KHR_synchronization2. Queue family 0 must support compute. */
  WalrDevice device = {.struct_size = sizeof(device), .get_instance_proc_addr = vkGetInstanceProcAddr};
  VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .apiVersion = VK_API_VERSION_1_3};
  VkInstanceCreateInfo instance = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, .pApplicationInfo = &application};
  check(vkCreateInstance(&instance, NULL, &device.instance));
  uint32_t count = 1;
  if (vkEnumeratePhysicalDevices(device.instance, &count, &device.physical_device) < 0) check(VK_NOT_READY);
  float priority = 1.0F;
  VkDeviceQueueCreateInfo queues = {
      .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, .queueCount = 1, .pQueuePriorities = &priority};
  VkPhysicalDeviceVulkan13Features vulkan13 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES,
                                               .synchronization2 = VK_TRUE};
  VkPhysicalDeviceFeatures features = {.shaderStorageImageExtendedFormats = VK_TRUE};
  VkDeviceCreateInfo device_info = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                    .pNext = &vulkan13,
                                    .queueCreateInfoCount = 1,
                                    .pQueueCreateInfos = &queues,
                                    .pEnabledFeatures = &features};
  check(vkCreateDevice(device.physical_device, &device_info, NULL, &device.device));
  VkQueue queue;
  vkGetDeviceQueue(device.device, 0, 0, &queue);
  VkCommandPoolCreateInfo pool_info = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  VkCommandPool pool;
  check(vkCreateCommandPool(device.device, &pool_info, NULL, &pool));

  WalrDenoiserInfo info = {.struct_size = sizeof(info), .device = &device, .width = kWidth, .height = kHeight};
  WalrDenoiser denoiser;
  check(walr_create_denoiser(&info, &denoiser));
  WalrImage images[kImages];
  for (int number = 0; number < kFrames; ++number) {
    VkCommandBufferAllocateInfo commands_info = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, .commandPool = pool, .commandBufferCount = 1};
    VkCommandBuffer commands;
    check(vkAllocateCommandBuffers(device.device, &commands_info, &commands));
    VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    check(vkBeginCommandBuffer(commands, &begin));
    for (int i = 0; i < kImages && number == 0; ++i) images[i] = make_image(device.device, denoiser, i, commands);

    WalrCamera camera = {.view = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, /* Column-major. */
                         .projection = {1.125F, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1, -1, 0, 0, -0.2F, 0}};
    WalrFrame frame = {.struct_size = sizeof(frame), .camera = &camera};
    frame.lighting = &images[0], frame.depth = &images[1], frame.normal = &images[2];
    frame.motion = &images[3], frame.albedo = &images[4], frame.denoised = &images[5];
    check(walr_record(denoiser, commands, &frame));
    for (int i = 0; i < kImages; ++i) check(walr_get_release_state(denoiser, kNames[i], &images[i].acquire));
    check(vkEndCommandBuffer(commands));
    VkSubmitInfo submit = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands};
    check(vkQueueSubmit(queue, 1, &submit, VK_NULL_HANDLE));
    check(vkQueueWaitIdle(queue));
  }
  printf("denoised %d frames with walr %s\n", kFrames, walr_version());
  check(walr_destroy_denoiser(denoiser));
  for (int i = 0; i < kImages; ++i)
    vkDestroyImage(device.device, images[i].image, NULL), vkFreeMemory(device.device, memory[i], NULL);
  vkDestroyCommandPool(device.device, pool, NULL);
  vkDestroyDevice(device.device, NULL);
  vkDestroyInstance(device.instance, NULL);
  return 0;
}
