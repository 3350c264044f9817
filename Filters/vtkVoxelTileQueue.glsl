// Triangles that wait for a later stage: large ones cut into tiles of columns, equal pieces of work, others as
// they are.
//
// TileQueue (storage buffer 2) begins with the arguments of two indirect dispatches, for the tiles, a
// workgroup each, and for the triangles, an invocation each. Items hold
//   from 0               (triangle, tile), where tile counts the TILE_SIZE x TILE_SIZE tiles of the rectangle
//                        of columns that the triangle may cover, row by row
//   from QUEUE_CAPACITY  (triangle, ALL_TILES), triangles for whose tiles no room was left
//   back from the end    (triangle, ALL_TILES), triangles to be done by one invocation
// with as many items behind QUEUE_CAPACITY as there are triangles, each of which waits once at most.

const uint TILE_SIZE = 64u;
const uint MAX_GROUPS = 32768u;
const uint QUEUE_CAPACITY = 262144u;
const uint ALL_TILES = 0xffffffffu;
const uint NO_TILE = 0xfffffffeu;

layout(std430, binding = 2) buffer TileQueue
{
  uint TileGroups[3];
  uint TriangleGroups[3];
  uint NumberOfTiles;
  uint NumberOfUncut;
  uint NumberOfWaiting;
  uint Unused;
  uvec2 Items[];
};

uvec2 tilesOf(ivec2 first, ivec2 end)
{
  return (uvec2(end - first) + TILE_SIZE - 1u) / TILE_SIZE;
}

void enqueueTriangle(uint triangle)
{
  uint index = atomicAdd(NumberOfWaiting, 1u);
  Items[uint(Items.length()) - 1u - index] = uvec2(triangle, ALL_TILES);
  atomicMax(TriangleGroups[0], min(index / gl_WorkGroupSize.x + 1u, MAX_GROUPS));
}

uint waitingTriangle(uint index)
{
  return Items[uint(Items.length()) - 1u - index].x;
}

void enqueueTiles(uint triangle, ivec2 first, ivec2 end)
{
  uvec2 tiles = tilesOf(first, end);
  uint count = tiles.x * tiles.y;
  // The counter is not added to once it is too high, so that it never overflows.
  uint begin = NumberOfTiles < QUEUE_CAPACITY ? atomicAdd(NumberOfTiles, count) : QUEUE_CAPACITY;
  bool fits = begin + count <= QUEUE_CAPACITY;
  uint stop = min(begin + count, QUEUE_CAPACITY);
  for (uint item = begin; item < stop; ++item)
  {
    Items[item] = uvec2(triangle, fits ? item - begin : NO_TILE);
  }
  uint uncut = fits ? 0u : atomicAdd(NumberOfUncut, 1u) + 1u;
  if (!fits)
  {
    Items[QUEUE_CAPACITY + uncut - 1u] = uvec2(triangle, ALL_TILES);
  }
  atomicMax(TileGroups[0], min(stop + uncut, MAX_GROUPS));
}

uint numberOfTileItems()
{
  return min(NumberOfTiles, QUEUE_CAPACITY) + NumberOfUncut;
}

uvec2 tileItem(uint index)
{
  uint tiles = min(NumberOfTiles, QUEUE_CAPACITY);
  return index < tiles ? Items[index] : Items[QUEUE_CAPACITY + index - tiles];
}

// The tiles of an item, half open, where the triangle has `count`.
uvec2 tilesOfItem(uvec2 item, uint count)
{
  return item.y == ALL_TILES ? uvec2(0u, count)
    : item.y == NO_TILE      ? uvec2(0u)
                             : uvec2(item.y, item.y + 1u);
}
