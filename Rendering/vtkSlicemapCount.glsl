// Counts the set bits of a slicemap.
//
// Quads            RGBA32UI buffer texture over the words
// storage buffer 0 the count, 64 bits as (low, high)
//
// An invocation sums every stride-th texel; NumberOfQuads texels in all.

layout(local_size_x = 64) in;

uniform usamplerBuffer Quads;
uniform uint NumberOfQuads;

layout(std430, binding = 0) buffer Count
{
  uint Low;
  uint High;
};

void main()
{
  uint stride = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  uint count = 0u;
  for (uint quad = gl_GlobalInvocationID.x; quad < NumberOfQuads; quad += stride)
  {
    ivec4 bits = bitCount(texelFetch(Quads, int(quad)));
    count += uint(bits.x + bits.y + bits.z + bits.w);
  }
  uint before = atomicAdd(Low, count);
  if (before + count < before)
  {
    atomicAdd(High, 1u);
  }
}
