// Large triangles, cut into tiles of columns: a queue of equal pieces of work.
//
// TileQueue (storage buffer 2) begins with the arguments of an indirect dispatch.
// Items[i] = (triangle, tile), where tile counts the TILE_SIZE x TILE_SIZE tiles of the rectangle of
// columns that the triangle may cover, row by row. Items past the end of the queue are not stored;
// their triangles are done at once by the invocation that found them.

const uint TILE_SIZE = 64u;
const uint MAX_TILE_GROUPS = 32768u;
const uint QUEUE_CAPACITY = 262144u;

layout(std430, binding = 2) buffer TileQueue
{
  uint NumberOfGroups;
  uint GroupsY;
  uint GroupsZ;
  uint NumberOfItems;
  uvec2 Items[];
};

uvec2 tilesOf(ivec2 first, ivec2 end)
{
  return (uvec2(end - first) + TILE_SIZE - 1u) / TILE_SIZE;
}

// False, with nothing queued, when there is no room left.
bool enqueueTiles(uint triangle, ivec2 first, ivec2 end)
{
  uvec2 tiles = tilesOf(first, end);
  uint count = tiles.x * tiles.y;
  uint begin = atomicAdd(NumberOfItems, count);
  if (begin + count > QUEUE_CAPACITY || begin + count < begin)
  {
    atomicAdd(NumberOfItems, uint(-int(count)));
    return false;
  }
  for (uint tile = 0u; tile < count; ++tile)
  {
    Items[begin + tile] = uvec2(triangle, tile);
  }
  atomicMax(NumberOfGroups, min(begin + count, MAX_TILE_GROUPS));
  return true;
}
