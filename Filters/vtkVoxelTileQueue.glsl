// Triangles that wait for a later stage: large ones cut into tiles of columns, equal pieces of work, others as
// they are. An invocation never does more than a row of some tiles, or one small triangle: renderers in software
// end the loops of an invocation after 65,535 turns in all.
//
// TileQueue (storage buffer 2) begins with the arguments of four indirect dispatches:
//   TILES      a workgroup for each tile that is in the queue, or several when there are many
//   UNCUT      a workgroup for each tile (x, y) of the grid and each triangle z that was left uncut
//   TRIANGLES  an invocation for each waiting triangle
//   SMALL      an invocation for each small triangle, where these were classified beforehand
// Items hold
//   from 0               (triangle, tile), where tile is y << 16 | x in the rectangle of TILE_SIZE x TILE_SIZE
//                        columns that the triangle may cover
//   from QUEUE_CAPACITY  (triangle, unused), triangles for whose tiles no room was left
//   back from QUEUE_CAPACITY + MeshTriangles
//                        (triangle, unused), triangles to be done by one invocation in a later stage
//   from QUEUE_CAPACITY + MeshTriangles
//                        (triangle, unused), small triangles, where these are classified beforehand
// where MeshTriangles is the number of all triangles, each of which waits once at most.
//
// The shader that works on tiles defines doTile(), an invocation a row; main() of TILES and UNCUT is here.

const uint TILE_SIZE = 64u;
const uint MAX_GROUPS = 32768u;
const uint QUEUE_CAPACITY = 262144u;
const uint MAX_TILES = 16384u;
const float MAX_COLUMNS = 8192.0;
const uint NO_TILE = 0xffffffffu;

layout(std430, binding = 2) buffer TileQueue
{
  uint TileGroups[3];
  uint UncutGroups[3];
  uint TriangleGroups[3];
  uint SmallGroups[3];
  uint NumberOfTiles;
  uint NumberOfUncut;
  uint NumberOfWaiting;
  uint NumberOfSmall;
  uint MeshTriangles;
  uint Unused;
  uvec2 Items[];
};

void enqueueTriangle(uint triangle)
{
  uint index = atomicAdd(NumberOfWaiting, 1u);
  Items[QUEUE_CAPACITY + MeshTriangles - 1u - index] = uvec2(triangle, 0u);
  uint group = index / gl_WorkGroupSize.x;
  atomicMax(TriangleGroups[0], min(group + 1u, MAX_GROUPS));
  atomicMax(TriangleGroups[1], group / MAX_GROUPS + 1u);
}

void enqueueSmall(uint triangle)
{
  uint index = atomicAdd(NumberOfSmall, 1u);
  Items[QUEUE_CAPACITY + MeshTriangles + index] = uvec2(triangle, 0u);
  uint group = index / gl_WorkGroupSize.x;
  atomicMax(SmallGroups[0], min(group + 1u, MAX_GROUPS));
  atomicMax(SmallGroups[1], group / MAX_GROUPS + 1u);
}

uint indexInStage()
{
  uint group = gl_WorkGroupID.y * MAX_GROUPS + gl_WorkGroupID.x;
  return group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}

// These two are false for invocations that have none.
bool waitingTriangle(out uint triangle)
{
  uint index = indexInStage();
  bool exists = index < NumberOfWaiting;
  triangle = exists ? Items[QUEUE_CAPACITY + MeshTriangles - 1u - index].x : 0u;
  return exists;
}

bool smallTriangle(out uint triangle)
{
  uint index = indexInStage();
  bool exists = index < NumberOfSmall;
  triangle = exists ? Items[QUEUE_CAPACITY + MeshTriangles + index].x : 0u;
  return exists;
}

// False when there is no room for the tiles of the rectangle, and nothing was done.
bool enqueueTiles(uint triangle, ivec2 first, ivec2 end)
{
  uvec2 tiles = (uvec2(end - first) + TILE_SIZE - 1u) / TILE_SIZE;
  uint count = tiles.x * tiles.y;
  // The counter is not added to once it is too high, so that it never overflows.
  bool mayFit = count <= MAX_TILES && NumberOfTiles < QUEUE_CAPACITY;
  uint begin = mayFit ? atomicAdd(NumberOfTiles, count) : QUEUE_CAPACITY;
  bool fits = begin + count <= QUEUE_CAPACITY;
  uint stop = min(begin + count, QUEUE_CAPACITY);
  for (uint item = begin; item < stop; ++item)
  {
    uint tile = item - begin;
    Items[item] = uvec2(triangle, fits ? tile / tiles.x << 16 | tile % tiles.x : NO_TILE);
  }
  atomicMax(TileGroups[0], min(stop, MAX_GROUPS));
  return fits;
}

void enqueueUncut(uint triangle)
{
  uint index = atomicAdd(NumberOfUncut, 1u);
  Items[QUEUE_CAPACITY + index] = uvec2(triangle, 0u);
  atomicMax(UncutGroups[2], min(index + 1u, MAX_GROUPS));
}

// Large triangles wait, as tiles or uncut. False when one invocation can do the triangle as well, and there is
// no room for its tiles.
bool deferTriangle(uint triangle, ivec2 first, ivec2 end)
{
  if (enqueueTiles(triangle, first, end))
  {
    return true;
  }
  vec2 size = vec2(end - first);
  bool isTooLarge = size.x * size.y > MAX_COLUMNS;
  if (isTooLarge)
  {
    enqueueUncut(triangle);
  }
  return isTooLarge;
}

// Nothing where the triangle has no such tile.
void doTile(uint triangle, uvec2 tile);

#if defined(TILES)

void main()
{
  uint items = min(NumberOfTiles, QUEUE_CAPACITY);
  for (uint index = gl_WorkGroupID.x; index < items; index += gl_NumWorkGroups.x)
  {
    uvec2 item = Items[index];
    if (item.y != NO_TILE)
    {
      doTile(item.x, uvec2(item.y & 0xffffu, item.y >> 16));
    }
  }
}

#elif defined(UNCUT)

void main()
{
  for (uint index = gl_WorkGroupID.z; index < NumberOfUncut; index += gl_NumWorkGroups.z)
  {
    doTile(Items[QUEUE_CAPACITY + index].x, gl_WorkGroupID.xy);
  }
}

#endif
