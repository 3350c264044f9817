// Triangles that wait for a later stage. An invocation never does more than a row of some tiles, or one small
// triangle: renderers in software end the loops of an invocation after 65,535 turns in all. They also run all of
// a shader, whatever its conditions and returns, so the first stage does no more than list what is to wait.
//
// TileQueue (storage buffer 2) begins with the arguments of five indirect dispatches:
//   CUT        a workgroup for each large triangle, which it does, or cuts into tiles when there are many
//   TILES      a workgroup for each tile that is in the queue, or several when there are many
//   UNCUT      a workgroup for each tile (x, y) of the grid and each triangle z that was left uncut
//   TRIANGLES  an invocation for each waiting triangle
//   REST       an invocation for each triangle that the first stage leaves to it
// A dispatch of one invocation with ARGUMENTS defined sets those that depend on the lists and
// empties the queue of tiles, for lists may be kept for more than one run.
//
// Items hold
//   from 0             (triangle, tile), where tile is y << 16 | x in the rectangle of TILE_SIZE x TILE_SIZE
//                      columns that the triangle may cover
//   from LISTS         large triangles
//   back from LISTS + MeshTriangles
//                      triangles to be done by one invocation in a later stage
//   from LISTS + MeshTriangles
//                      large triangles for whose tiles no room was left
//   from LISTS + 2 MeshTriangles
//                      triangles that the first stage leaves to REST
// where MeshTriangles is the number of all triangles, each of which is in one list of the first stage at most.
//
// The shader that works on tiles defines rectangleOf() and doTile(), an invocation a row; main() of CUT, TILES
// and UNCUT is here.

#ifdef ARGUMENTS
layout(local_size_x = 1) in;
#endif

const uint TILE_SIZE = 64u;
const uint MAX_GROUPS = 32768u;
const uint QUEUE_CAPACITY = 262144u;
const uint LISTS = 2u * QUEUE_CAPACITY;
const uint MAX_TILES = 16384u;
const uint NO_TILE = 0xffffffffu;

// A workgroup does so many tiles by itself; and so many where there is no room for them.
const uint FEW_TILES = 4u;
const uint MANY_TILES = 128u;

layout(std430, binding = 2) buffer TileQueue
{
  uint CutGroups[3];
  uint TileGroups[3];
  uint UncutGroups[3];
  uint TriangleGroups[3];
  uint RestGroups[3];
  uint NumberOfLarge;
  uint NumberOfTiles;
  uint NumberOfUncut;
  uint NumberOfWaiting;
  uint NumberOfRest;
  uint MeshTriangles;
  uint Items[];
};

void enqueueLarge(uint triangle)
{
  Items[LISTS + atomicAdd(NumberOfLarge, 1u)] = triangle;
}

void enqueueTriangle(uint triangle)
{
  Items[LISTS + MeshTriangles - 1u - atomicAdd(NumberOfWaiting, 1u)] = triangle;
}

void enqueueRest(uint triangle)
{
  Items[LISTS + 2u * MeshTriangles + atomicAdd(NumberOfRest, 1u)] = triangle;
}

uint groupInStage()
{
  return gl_WorkGroupID.y * MAX_GROUPS + gl_WorkGroupID.x;
}

uint indexInStage()
{
  return groupInStage() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}

// These two are false for invocations that have none.
bool waitingTriangle(out uint triangle)
{
  uint index = indexInStage();
  bool exists = index < NumberOfWaiting;
  triangle = exists ? Items[LISTS + MeshTriangles - 1u - index] : 0u;
  return exists;
}

bool restTriangle(out uint triangle)
{
  uint index = indexInStage();
  bool exists = index < NumberOfRest;
  triangle = exists ? Items[LISTS + 2u * MeshTriangles + index] : 0u;
  return exists;
}

// The columns that the triangle may cover, half open.
void rectangleOf(uint triangle, out ivec2 first, out ivec2 end);

// Nothing where the triangle has no such tile.
void doTile(uint triangle, uvec2 tile);

#if defined(ARGUMENTS)

uint[3] groupsFor(uint count)
{
  return uint[3](min(count, MAX_GROUPS), (count + MAX_GROUPS - 1u) / MAX_GROUPS, 1u);
}

uint groupsOfInvocations(uint count)
{
  const uint groupSize = 64u;
  return (count + groupSize - 1u) / groupSize;
}

void main()
{
  CutGroups = groupsFor(NumberOfLarge);
  TriangleGroups = groupsFor(groupsOfInvocations(NumberOfWaiting));
  RestGroups = groupsFor(groupsOfInvocations(NumberOfRest));
  TileGroups[0] = 0u;
  NumberOfTiles = 0u;
  UncutGroups[2] = 0u;
  NumberOfUncut = 0u;
}

#elif defined(CUT)

shared uint SharedBegin;

// The first item of the tiles: QUEUE_CAPACITY or too close to it when there is no room, or no need.
uint reserveTiles(uint count)
{
  // The counter is not added to once it is too high, so that it never overflows.
  bool mayFit = count > FEW_TILES && count <= MAX_TILES && NumberOfTiles < QUEUE_CAPACITY;
  if (!mayFit)
  {
    return QUEUE_CAPACITY;
  }
  uint begin = atomicAdd(NumberOfTiles, count);
  atomicMax(TileGroups[0], min(begin + count, MAX_GROUPS));
  return begin;
}

void main()
{
  bool exists = groupInStage() < NumberOfLarge;
  uint triangle = exists ? Items[LISTS + groupInStage()] : 0u;
  ivec2 first, end;
  rectangleOf(triangle, first, end);
  uvec2 tiles = exists ? (uvec2(end - first) + TILE_SIZE - 1u) / TILE_SIZE : uvec2(0u);
  uint count = tiles.x * tiles.y;
  uint row = gl_LocalInvocationID.x;
  if (row == 0u)
  {
    SharedBegin = reserveTiles(count);
  }
  barrier();
  uint begin = SharedBegin;

  bool fits = begin + count <= QUEUE_CAPACITY;
  for (uint tile = row; tile < count && begin + tile < QUEUE_CAPACITY; tile += gl_WorkGroupSize.x)
  {
    uint item = 2u * (begin + tile);
    Items[item] = triangle;
    Items[item + 1u] = fits ? tile / tiles.x << 16 | tile % tiles.x : NO_TILE;
  }
  bool isUncut = !fits && count > MANY_TILES;
  for (uint tile = 0u; tile < (fits || isUncut ? 0u : count); ++tile)
  {
    doTile(triangle, uvec2(tile % tiles.x, tile / tiles.x));
  }
  if (isUncut && row == 0u)
  {
    uint index = atomicAdd(NumberOfUncut, 1u);
    Items[LISTS + MeshTriangles + index] = triangle;
    atomicMax(UncutGroups[2], min(index + 1u, MAX_GROUPS));
  }
}

#elif defined(TILES)

void main()
{
  uint items = min(NumberOfTiles, QUEUE_CAPACITY);
  for (uint index = gl_WorkGroupID.x; index < items; index += gl_NumWorkGroups.x)
  {
    uint triangle = Items[2u * index];
    uint tile = Items[2u * index + 1u];
    if (tile != NO_TILE)
    {
      doTile(triangle, uvec2(tile & 0xffffu, tile >> 16));
    }
  }
}

#elif defined(UNCUT)

void main()
{
  for (uint index = gl_WorkGroupID.z; index < NumberOfUncut; index += gl_NumWorkGroups.z)
  {
    doTile(Items[LISTS + MeshTriangles + index], gl_WorkGroupID.xy);
  }
}

#endif
