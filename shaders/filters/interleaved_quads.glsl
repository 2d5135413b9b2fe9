// Which pixels a work group filters whose taps are an even number of pixels apart: quads of 2 x 2 pixels, as far apart as
// taps. The pixels of the group and of all its taps then form one square tile of quads, which is small enough for shared
// memory. Other groups filter the quads between.
#ifndef WALR_INTERLEAVED_QUADS_GLSL
#define WALR_INTERLEAVED_QUADS_GLSL

// Pixel at a place in the tile of a group of `side` x `side` pixels. Place 0 is the first pixel that the group filters.
ivec2 pixelOfQuads(ivec2 place, int side, int spacing) {
  const uvec2 group = gl_WorkGroupID.xy;
  const uint interleaved = uint(spacing) / 2u;  // Groups per axis that filter the same area.
  const uvec2 first = group / interleaved * (uint(side) * interleaved) + group % interleaved * 2u;
  return ivec2(first) + (place >> 1) * spacing + (place & 1);
}

#endif
