/* Misuse of the C API always gives an error code and a text. It never crashes, and nothing is recorded. */
#include <stdio.h>
#include <stdlib.h>

#include "misuse.h"

int main(void) {
  Host host;
  host_open(&host);
  const WalrDevice device = device_of(&host);
  test_descriptions(&host, &device);
  test_objects(&device);
  test_frames(&host, &device);
  const int messages = host_close(&host);
  if (failures + messages > 0) fprintf(stderr, "%d failures, %d validation messages\n", failures, messages);
  return failures + messages > 0 ? EXIT_FAILURE : EXIT_SUCCESS;
}
