// Kernel of vtkDensityPass: sums of numbers along y or z, for 128 voxels along x at once. See
// vtkSlicemapQuadKernel.h: a quad is four words. Follows vtkDensityAdder.glsl.
//
// Numbers are spread over planes: bit b of plane p of a quad is worth 2^p in the number of voxel b
// of that quad. The planes of a quad follow one another.
//
// AXIS           1 or 2: along y or z
// SOURCE_PLANES  planes of the numbers that are added
// PLANES         planes of their sums
//
// Source      the numbers, a plane of a quad each texel; or the words of a slicemap, one plane
// SourceSize  its quads of a row, rows of a slice, and slices
// Size        the same of the result
// Taps        how many numbers are added: that of the result at i begins with the source at
// First       i * Stride + First, and goes on in steps of
// Step        so many voxels; beyond the source numbers are 0
// Stride

uniform usamplerBuffer Source;
uniform ivec3 SourceSize;
uniform ivec3 Size;
uniform int Taps;
uniform int First;
uniform int Step;
uniform int Stride;

void kernel(uint quad, out uvec4 sum[PLANES])
{
  uint row = quad / uint(Size.x);
  ivec3 place = ivec3(quad % uint(Size.x), row % uint(Size.y), row / uint(Size.y));
  for (int p = 0; p < PLANES; ++p)
  {
    sum[p] = uvec4(0u);
  }
  int at = place[AXIS] * Stride + First;
  for (int tap = 0; tap < Taps; ++tap)
  {
    place[AXIS] = clamp(at, 0, SourceSize[AXIS] - 1);
    uint inside = place[AXIS] == at ? FULL_WORD : 0u;
    uint first =
      uint((place.z * SourceSize.y + place.y) * SourceSize.x + place.x) * uint(SOURCE_PLANES);
    uvec4 carry = uvec4(0u);
    for (int p = 0; p < SOURCE_PLANES; ++p)
    {
      addPlane(sum[p], sourceQuad(Source, first + uint(p)) & inside, carry);
    }
    for (int p = SOURCE_PLANES; p < PLANES; ++p)
    {
      addPlane(sum[p], uvec4(0u), carry);
    }
    at += Step;
  }
}
