#include <string.h>
#include <walr/walr.h>

int main(void) {
  return strlen(walr_version()) > 0 ? 0 : 1;
}
