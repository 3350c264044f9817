// Kernel of vtkDensityPass: sums of numbers along x, for 128 voxels at once. Numbers are spread over
// planes as vtkDensitySums.glsl has them. Follows vtkDensityAdder.glsl.
//
// KERNEL         how many numbers are added: 2, 4, 8, 16 or 32
// DOWNSAMPLED    defined: those of blocks, one sum a block; otherwise those from KERNEL / 2 voxels
//                before each voxel on
// SOURCE_PLANES  planes of the numbers that are added
// PLANES         planes of their sums
// RUNS           defined: so many quads of a row by one call; not with DOWNSAMPLED
//
// Source       the numbers, a plane of a quad each texel; zero beyond the end of a row
// SourceQuads  its quads of a row
// QuadsPerRow        quads of a row of the result

uniform usamplerBuffer Source;
uniform int SourceQuads;
uniform int QuadsPerRow;

// A plane of a quad; zero beyond the row.
uvec4 planeAt(int row, int quad, int plane)
{
  int within = clamp(quad, 0, SourceQuads - 1);
  uint texel = uint(row * SourceQuads + within) * uint(SOURCE_PLANES) + uint(plane);
  return sourceQuad(Source, texel) & (quad == within ? FULL_WORD : 0u);
}

#ifdef DOWNSAMPLED

// Words with so many bits set at the begin of each period.
uint runsOfBits(int bits, int period)
{
  uint runs = 0u;
  for (int at = 0; at < 32; at += period)
  {
    runs |= ((1u << uint(bits)) - 1u) << uint(at);
  }
  return runs;
}

// Every KERNEL-th bit of each word, one after the other.
uvec4 gathered(uvec4 words)
{
  words &= runsOfBits(1, KERNEL);
  for (int run = 1; run < 32 / KERNEL; run *= 2)
  {
    words = (words | words >> uint(run * (KERNEL - 1))) & runsOfBits(2 * run, 2 * run * KERNEL);
  }
  return words;
}

void kernel(uint quad, out uvec4 sum[PLANES])
{
  int row = int(quad) / QuadsPerRow;
  int firstQuad = int(quad) % QuadsPerRow * KERNEL;
  for (int p = 0; p < PLANES; ++p)
  {
    sum[p] = uvec4(0u);
  }
  for (int i = 0; i < KERNEL; ++i)
  {
    uvec4 blocks[PLANES];
    for (int p = 0; p < PLANES; ++p)
    {
      blocks[p] = p < SOURCE_PLANES ? planeAt(row, firstQuad + i, p) : uvec4(0u);
    }
    for (int covered = 1; covered < KERNEL; covered *= 2)
    {
      uvec4 carry = uvec4(0u);
      for (int p = 0; p < PLANES; ++p)
      {
        addPlane(blocks[p], blocks[p] >> uint(covered), carry);
      }
    }
    for (int p = 0; p < PLANES; ++p)
    {
      uvec4 bits = gathered(blocks[p]);
      for (int word = 0; word < 4; ++word)
      {
        uint at = uint((4 * i + word) * (32 / KERNEL));
        uvec4 here = uvec4(equal(uvec4(0u, 1u, 2u, 3u), uvec4(at / WORD_BITS)));
        sum[p] |= here * (bits[word] << (at % WORD_BITS));
      }
    }
  }
}

#else

// Of a quad, and of the words beside it: sums from each voxel on, moved to begin KERNEL / 2 before.
void sumFrom(uvec4 here[SOURCE_PLANES], uvec2 besideHere[SOURCE_PLANES], out uvec4 sum[PLANES])
{
  uvec2 beside[PLANES];
  for (int p = 0; p < PLANES; ++p)
  {
    sum[p] = p < SOURCE_PLANES ? here[min(p, SOURCE_PLANES - 1)] : uvec4(0u);
    beside[p] = p < SOURCE_PLANES ? besideHere[min(p, SOURCE_PLANES - 1)] : uvec2(0u);
  }
  for (int covered = 1; covered < KERNEL; covered *= 2)
  {
    uint shift = uint(covered);
    uint rest = WORD_BITS - shift;
    uvec4 carry = uvec4(0u);
    uvec2 carryBeside = uvec2(0u);
    for (int p = 0; p < PLANES; ++p)
    {
      uvec4 value = sum[p] >> shift | uvec4(sum[p].yzw, beside[p].y) << rest;
      uvec2 valueBeside = beside[p] >> shift | uvec2(sum[p].x << rest, 0u);
      addPlane(sum[p], value, carry);
      addPlane(beside[p], valueBeside, carryBeside);
    }
  }
  const uint back = uint(KERNEL / 2);
  for (int p = 0; p < PLANES; ++p)
  {
    sum[p] = sum[p] << back | uvec4(beside[p].x, sum[p].xyz) >> (WORD_BITS - back);
  }
}

#ifdef RUNS

void run(uint call)
{
  int runsPerRow = (QuadsPerRow + RUNS - 1) / RUNS;
  int row = int(call) / runsPerRow;
  int begin = int(call) % runsPerRow * RUNS;
  int end = min(begin + RUNS, QuadsPerRow);
  uvec4 here[SOURCE_PLANES];
  uvec4 behind[SOURCE_PLANES];
  uvec2 beside[SOURCE_PLANES];
  for (int p = 0; p < SOURCE_PLANES; ++p)
  {
    here[p] = planeAt(row, begin - 1, p);
    behind[p] = planeAt(row, begin, p);
  }
  for (int quad = begin; quad < end; ++quad)
  {
    for (int p = 0; p < SOURCE_PLANES; ++p)
    {
      beside[p].x = here[p].w;
      here[p] = behind[p];
      behind[p] = planeAt(row, quad + 1, p);
      beside[p].y = behind[p].x;
    }
    uvec4 sum[PLANES];
    sumFrom(here, beside, sum);
    put(uint(row * QuadsPerRow + quad), sum);
  }
}

#else

void kernel(uint quad, out uvec4 sum[PLANES])
{
  int row = int(quad) / QuadsPerRow;
  int place = int(quad) % QuadsPerRow;
  uvec4 here[SOURCE_PLANES];
  uvec2 beside[SOURCE_PLANES];
  for (int p = 0; p < SOURCE_PLANES; ++p)
  {
    here[p] = planeAt(row, place, p);
    beside[p] = uvec2(planeAt(row, place - 1, p).w, planeAt(row, place + 1, p).x);
  }
  sumFrom(here, beside, sum);
}

#endif
#endif
