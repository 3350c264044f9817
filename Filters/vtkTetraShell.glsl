// The voxels of a solid with a neighbour that is not in it; see vtkSlicemapQuadKernel.h: a quad is four
// words, 128 voxels along x. Voxels beyond the grid are not in the solid.
//
// NEIGHBOURS   6, 18 or 26
// ONE_QUAD     defined when a row has one quad
//
// Solid        the words of the solid, four a texel
// Size         number of voxels along x, y and z of a grid; there may be several, one behind the other along z
// QuadsPerRow  number of texels of a row

uniform usamplerBuffer Solid;
uniform ivec3 Size;
uniform uint QuadsPerRow;

// On how many of the axes y and z a neighbour may be off; and one that is off along x as well.
const int MOST_OFF = NEIGHBOURS == 6 ? 1 : 2;
const int MOST_OFF_IN_LINES = NEIGHBOURS == 6 ? 0 : NEIGHBOURS == 18 ? 1 : 2;

// The first quad of the grid at hand.
int Begin;

uvec4 quadAt(ivec3 at)
{
  bool inside = at.x >= 0 && at.x < int(QuadsPerRow) && at.y >= 0 && at.y < Size.y && at.z >= 0 &&
    at.z < Size.z;
  int row = at.z * Size.y + at.y;
  return inside ? sourceQuad(Solid, uint(Begin + row * int(QuadsPerRow) + at.x)) : uvec4(0u);
}

uvec4 kernel(uint quad)
{
  uvec4 solid = sourceQuad(Solid, quad);
  uvec4 shell = solid;
  // Renderers in software skip loops, but not branches: most quads are empty.
  for (bool isLeft = solid != uvec4(0u); isLeft; isLeft = false)
  {
    int row = int(quad / QuadsPerRow) % (Size.y * Size.z);
    ivec3 place = ivec3(int(quad % QuadsPerRow), row % Size.y, row / Size.y);
    Begin = int(quad) - row * int(QuadsPerRow) - place.x;
    uvec4 all = solid;
    uvec4 lines = uvec4(FULL_WORD);
    uint before = FULL_WORD;
    uint behind = FULL_WORD;
    for (int z = -1; z <= 1; ++z)
    {
      for (int y = -1; y <= 1; ++y)
      {
        int off = abs(y) + abs(z);
        if (off <= MOST_OFF)
        {
          ivec3 at = place + ivec3(0, y, z);
          uvec4 here = quadAt(at);
          all &= here;
          if (off <= MOST_OFF_IN_LINES)
          {
            lines &= here;
#ifdef ONE_QUAD
            before = 0u;
            behind = 0u;
#else
            before &= quadAt(at - ivec3(1, 0, 0)).w;
            behind &= quadAt(at + ivec3(1, 0, 0)).x;
#endif
          }
        }
      }
    }
    uvec4 lower = lines << 1u | uvec4(before, lines.xyz) >> 31u;
    uvec4 upper = lines >> 1u | uvec4(lines.yzw, behind) << 31u;
    shell = solid & ~(all & lower & upper);
  }
  return shell;
}
