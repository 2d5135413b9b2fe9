#ifndef WALR_SHADERS_CONVENTIONS_PACKED_LIGHT_H
#define WALR_SHADERS_CONVENTIONS_PACKED_LIGHT_H
#ifdef __cplusplus
namespace walr {
#endif

// The level of a packed history length in three bits that stands for the longest. The others are 0 and 2^(level - 1).
const int kLongestLevel = 7;

#ifdef __cplusplus
}  // namespace walr
#endif
#endif
