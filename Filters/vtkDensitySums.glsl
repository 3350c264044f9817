// Kernel of vtkDensityPass: sums of numbers along y or z, for 128 voxels along x at once. See
// vtkSlicemapQuadKernel.h: a quad is four words. Follows vtkDensityAdder.glsl.
//
// Numbers are spread over planes: bit b of plane p of a quad is worth 2^p in the number of voxel b
// of that quad. The planes of a quad follow one another.
//
// AXIS           1 or 2: along y or z
// SOURCE_PLANES  planes of the numbers that are added
// PLANES         planes of their sums
// RUNS           defined: so many voxels along AXIS by one call
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

// Texel of the first plane at a place whose index along AXIS may lie beyond the source, and all bits
// set where it doesn't.
struct Place
{
  uint Texel;
  uint Inside;
};

Place placeAt(ivec3 place, int at)
{
  place[AXIS] = clamp(at, 0, SourceSize[AXIS] - 1);
  uint quad = uint((place.z * SourceSize.y + place.y) * SourceSize.x + place.x);
  return Place(quad * uint(SOURCE_PLANES), place[AXIS] == at ? FULL_WORD : 0u);
}

void add(inout uvec4 sum[PLANES], Place place)
{
  uvec4 carry = uvec4(0u);
  for (int p = 0; p < SOURCE_PLANES; ++p)
  {
    addPlane(sum[p], sourceQuad(Source, place.Texel + uint(p)) & place.Inside, carry);
  }
  for (int p = SOURCE_PLANES; p < PLANES; ++p)
  {
    addPlane(sum[p], uvec4(0u), carry);
  }
}

// Of the number of the result at a place.
void addTaps(ivec3 place, out uvec4 sum[PLANES])
{
  for (int p = 0; p < PLANES; ++p)
  {
    sum[p] = uvec4(0u);
  }
  int at = place[AXIS] * Stride + First;
  for (int tap = 0; tap < Taps; ++tap)
  {
    add(sum, placeAt(place, at));
    at += Step;
  }
}

#ifdef RUNS

void subtract(inout uvec4 sum[PLANES], Place place)
{
  uvec4 borrow = uvec4(0u);
  for (int p = 0; p < SOURCE_PLANES; ++p)
  {
    subtractPlane(sum[p], sourceQuad(Source, place.Texel + uint(p)) & place.Inside, borrow);
  }
  for (int p = SOURCE_PLANES; p < PLANES; ++p)
  {
    subtractPlane(sum[p], uvec4(0u), borrow);
  }
}

// RUNS voxels along AXIS: of each, the sum is that of the one before, with one number more and one
// less. Step and Stride are 1.
void run(uint call)
{
  ivec3 runs = Size;
  runs[AXIS] = (Size[AXIS] + RUNS - 1) / RUNS;
  uint row = call / uint(runs.x);
  ivec3 place = ivec3(call % uint(runs.x), row % uint(runs.y), row / uint(runs.y));
  int begin = place[AXIS] * RUNS;
  int end = min(begin + RUNS, Size[AXIS]);
  place[AXIS] = begin;
  uvec4 sum[PLANES];
  addTaps(place, sum);
  for (int at = begin; at < end; ++at)
  {
    place[AXIS] = at;
    put(uint((place.z * Size.y + place.y) * Size.x + place.x), sum);
    add(sum, placeAt(place, at + First + Taps));
    subtract(sum, placeAt(place, at + First));
  }
}

#else

void kernel(uint quad, out uvec4 sum[PLANES])
{
  uint row = quad / uint(Size.x);
  addTaps(ivec3(quad % uint(Size.x), row % uint(Size.y), row / uint(Size.y)), sum);
}

#endif
