// Quiet tiles: no pixel of them can have a share of accumulated light (passes/WALR.md, 9). In turn, each is measured in two
// frames of kQuietFrames, because innovations take two.
#ifndef WALR_QUIET_TILES_GLSL
#define WALR_QUIET_TILES_GLSL

const uint kQuietFrames = 16u;

bool isMeasuredThoughQuiet(uvec2 tile, uint frameIndex) {
  return (tile.x + 3u * tile.y + 5u * (frameIndex / 2u)) % (kQuietFrames / 2u) == 0u;
}
// Whether this is the second of the two frames.
bool haveQuietInnovations(uint frameIndex) { return frameIndex % 2u == 1u; }

// What is known of a tile, beside its statistics, in one number. It is 0 where nothing is.
// `withEdges`: frames for which the tile still counts as one with pixels beside an edge.
float tileState(bool quiet, float withEdges) { return withEdges + (quiet ? 0.5 : 0.0); }
bool isQuiet(float state) { return fract(state) > 0.25; }
vec4 quietness(vec4 states) { return 2.0 * fract(states); }  // 1 where a tile is quiet, else 0.
float framesWithEdges(float state) { return floor(state); }

#endif
