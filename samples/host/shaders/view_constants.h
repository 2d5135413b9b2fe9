// Parameters of the view that may change from frame to frame: one uniform block.
#ifndef WALR_HOST_VIEW_CONSTANTS_H
#define WALR_HOST_VIEW_CONSTANTS_H
#ifdef __cplusplus
namespace walr::host {
#endif

struct ViewConstants {
  int leftEdge;    // Split view, pixels: columns to the left of it show the noisy image.
  int rightEdge;   // Split view, pixels: this column and those to the right show the reference.
  int middleEdge;  // Comparison of two methods, pixels: this column and those to the right show the second.
  float gain;      // Texture view: values are multiplied by it.
  float bias;      // Texture view: added to the scaled values.
  float stops;     // Exposure of lit images: they are multiplied by 2 to this power before the tone map.
};

#ifdef __cplusplus
}  // namespace walr::host
#endif
#endif
