// Bit masks of the slices of a pass: Eisemann & Decoret 2008, sections 5.2 and 5.3.
//
// TARGETS      number of render targets, 128 slices each: slice s is bit s % 32 of channel s / 32 % 4
//              of target s / 128
// MaskTable    RGBA32UI texture of 129 x 1 texels; texel k has the bits k, k + 1, ... of 128 set

const int SLICES_PER_TARGET = 128;

uniform usampler2D MaskTable;

out uvec4 Masks[TARGETS];

uvec4 slicesFrom(int slice, int target)
{
  int inTarget = clamp(slice - target * SLICES_PER_TARGET, 0, SLICES_PER_TARGET);
  return texelFetch(MaskTable, ivec2(inTarget, 0), 0);
}
