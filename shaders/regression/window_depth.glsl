// The reference depth of a window that no edge ends. It is the harmonic mean of the depths, which bounds the depth
// feature: the mean of the feature is then 0.
#ifndef WALR_WINDOW_DEPTH_GLSL
#define WALR_WINDOW_DEPTH_GLSL

struct WindowDepth {
  float weights;
  float inverse;
};

void add(inout WindowDepth window, float weight, float z) {
  if (z == 0.0) return;
  window.weights += weight;
  window.inverse += weight / z;
}

float harmonicMean(WindowDepth window) { return window.weights > 0.0 ? window.weights / window.inverse : 0.0; }

#endif
