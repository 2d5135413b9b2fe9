// Bindings of the moments of blocks, and their loads and stores.
// BLOCK_MOMENTS_IN: reads moments and depth of blocks (or cells).
// BLOCK_MOMENTS_OUT: writes them.
// CELL_MOMENTS_OUT: writes moments and depth of cells, beside those of blocks.
#ifndef WALR_BLOCK_TEXTURES_GLSL
#define WALR_BLOCK_TEXTURES_GLSL
#include "regression/block_storage.glsl"

#ifdef BLOCK_MOMENTS_IN
uniform utexture2D moments0;
uniform utexture2D moments1;
uniform utexture2D moments2;
uniform utexture2D moments3;
uniform utexture2D moments4;
uniform utexture2D depth;

BlockMoments loadMoments(ivec2 block) {
  PackedBlock p;
  p.word = uvec4[](texelFetch(moments0, block, 0), texelFetch(moments1, block, 0), texelFetch(moments2, block, 0),
                   texelFetch(moments3, block, 0), texelFetch(moments4, block, 0));
  return unpackBlock(p);
}

bool insideGrid(ivec2 block) {
  return all(greaterThanEqual(block, ivec2(0))) && all(lessThan(block, textureSize(depth, 0)));
}
#endif

#ifdef BLOCK_MOMENTS_OUT
layout(rgba32ui) uniform writeonly uimage2D outMoments0;
layout(rgba32ui) uniform writeonly uimage2D outMoments1;
layout(rgba32ui) uniform writeonly uimage2D outMoments2;
layout(rgba32ui) uniform writeonly uimage2D outMoments3;
layout(rgba32ui) uniform writeonly uimage2D outMoments4;
layout(r32ui) uniform writeonly uimage2D outDepth;

void storeMoments(ivec2 block, PackedBlock p) {
  imageStore(outMoments0, block, p.word[0]);
  imageStore(outMoments1, block, p.word[1]);
  imageStore(outMoments2, block, p.word[2]);
  imageStore(outMoments3, block, p.word[3]);
  imageStore(outMoments4, block, p.word[4]);
}
#endif

#ifdef CELL_MOMENTS_OUT
layout(rgba32ui) uniform writeonly uimage2D outCellMoments0;
layout(rgba32ui) uniform writeonly uimage2D outCellMoments1;
layout(rgba32ui) uniform writeonly uimage2D outCellMoments2;
layout(rgba32ui) uniform writeonly uimage2D outCellMoments3;
layout(rgba32ui) uniform writeonly uimage2D outCellMoments4;
layout(r32ui) uniform writeonly uimage2D outCellDepth;

void storeCellMoments(ivec2 cell, PackedBlock p) {
  imageStore(outCellMoments0, cell, p.word[0]);
  imageStore(outCellMoments1, cell, p.word[1]);
  imageStore(outCellMoments2, cell, p.word[2]);
  imageStore(outCellMoments3, cell, p.word[3]);
  imageStore(outCellMoments4, cell, p.word[4]);
}
#endif

#endif
