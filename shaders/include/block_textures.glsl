// The textures of blocks: BLOCK_MOMENTS_IN reads moments and depth, BLOCK_MOMENTS_OUT writes them, CELL_MOMENTS_OUT writes
// those of cells, BLOCK_FIT_OUT writes fits, and depth where that is not known from before.
#ifndef WALR_BLOCK_TEXTURES_GLSL
#define WALR_BLOCK_TEXTURES_GLSL
#include "block_storage.glsl"

#ifdef BLOCK_MOMENTS_IN
layout(set = 0, binding = 5) uniform utexture2D moments0;
layout(set = 0, binding = 6) uniform utexture2D moments1;
layout(set = 0, binding = 7) uniform utexture2D moments2;
layout(set = 0, binding = 8) uniform utexture2D moments3;
layout(set = 0, binding = 9) uniform utexture2D moments4;
layout(set = 0, binding = 10) uniform utexture2D depth;

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
layout(set = 0, binding = 12, rgba32ui) uniform writeonly uimage2D outMoments0;
layout(set = 0, binding = 13, rgba32ui) uniform writeonly uimage2D outMoments1;
layout(set = 0, binding = 14, rgba32ui) uniform writeonly uimage2D outMoments2;
layout(set = 0, binding = 15, rgba32ui) uniform writeonly uimage2D outMoments3;
layout(set = 0, binding = 16, rgba32ui) uniform writeonly uimage2D outMoments4;
layout(set = 0, binding = 17, r32ui) uniform writeonly uimage2D outDepth;

void storeMoments(ivec2 block, BlockMoments m) {
  const PackedBlock p = packBlock(m);
  imageStore(outMoments0, block, p.word[0]);
  imageStore(outMoments1, block, p.word[1]);
  imageStore(outMoments2, block, p.word[2]);
  imageStore(outMoments3, block, p.word[3]);
  imageStore(outMoments4, block, p.word[4]);
}
#endif

#ifdef CELL_MOMENTS_OUT
layout(set = 0, binding = 19, rgba32ui) uniform writeonly uimage2D outCellMoments0;
layout(set = 0, binding = 20, rgba32ui) uniform writeonly uimage2D outCellMoments1;
layout(set = 0, binding = 21, rgba32ui) uniform writeonly uimage2D outCellMoments2;
layout(set = 0, binding = 22, rgba32ui) uniform writeonly uimage2D outCellMoments3;
layout(set = 0, binding = 23, rgba32ui) uniform writeonly uimage2D outCellMoments4;
layout(set = 0, binding = 24, r32ui) uniform writeonly uimage2D outCellDepth;

void storeCellMoments(ivec2 cell, BlockMoments m) {
  const PackedBlock p = packBlock(m);
  imageStore(outCellMoments0, cell, p.word[0]);
  imageStore(outCellMoments1, cell, p.word[1]);
  imageStore(outCellMoments2, cell, p.word[2]);
  imageStore(outCellMoments3, cell, p.word[3]);
  imageStore(outCellMoments4, cell, p.word[4]);
}
#endif

#ifdef BLOCK_FIT_OUT
layout(set = 0, binding = 12, rgba32ui) uniform writeonly uimage2D outFitA;
layout(set = 0, binding = 13, rgba32ui) uniform writeonly uimage2D outFitB;
layout(set = 0, binding = 14, rgba32ui) uniform writeonly uimage2D outFitC;
layout(set = 0, binding = 15, r32ui) uniform writeonly uimage2D outDepth;

void storeFit(ivec2 block, BlockFit fit) {
  const PackedFit p = packFit(fit);
  imageStore(outFitA, block, p.a);
  imageStore(outFitB, block, p.b);
  imageStore(outFitC, block, p.c);
}
#endif

#endif
