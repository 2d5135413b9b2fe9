// What of the view changes from frame to frame: one uniform block.
#ifndef WALR_HOST_VIEW_CONSTANTS_H
#define WALR_HOST_VIEW_CONSTANTS_H
#ifdef __cplusplus
namespace walr::host {
#endif

struct ViewConstants {
  int leftEdge;   // Split view, pixels: columns before it show the noisy picture.
  int rightEdge;  // Split view, pixels: columns from it on show the reference.
  float gain;     // Texture view: values are multiplied by it.
  float bias;     // Texture view: and this is added.
};

#ifdef __cplusplus
}  // namespace walr::host
#endif
#endif
