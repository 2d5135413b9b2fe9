#include "temporal/reprojection.glsl"
