/* A host that destroys its device and forgets its denoiser and its passes: the program still ends in order, with its
 * output written. The test expects the last line and exit code 0. */
#include <stdio.h>
#include <stdlib.h>

#include <walr/specular_albedo.h> /* Is C, too. */
#include <walr/walr_passes.h>

#include "host/vulkan_host.h"

int main(void) {
  static Host host;
  host_open(&host);
  const WalrDevice device = {.struct_size = sizeof(WalrDevice),
                             .queue_family = host.queue_family,
                             .instance = host.instance,
                             .physical_device = host.physical_device,
                             .device = host.device,
                             .get_instance_proc_addr = vkGetInstanceProcAddr};
  const WalrDenoiserInfo info = {.struct_size = sizeof(WalrDenoiserInfo), .device = &device, .width = 64, .height = 48};
  const WalrPassesInfo passes_info = {.struct_size = sizeof(WalrPassesInfo), .denoiser = &info};
  WalrDenoiser denoiser = NULL;
  WalrPasses passes = NULL;
  if (walr_create_denoiser(&info, &denoiser) != WALR_SUCCESS || walr_prepare(denoiser) != WALR_SUCCESS ||
      walr_create_passes(&passes_info, &passes) != WALR_SUCCESS) {
    fprintf(stderr, "%s\n", walr_last_error());
    return EXIT_FAILURE;
  }
  /* The validation layer reports the objects that the device still has, as it should: the messages are not counted. */
  host_close(&host);
  printf("left objects behind");
  return EXIT_SUCCESS;
}
