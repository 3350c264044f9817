// By how much the points of a vtkVoxelMesh are moved; goes before the file that fetches them.
//
// DISPLACED       defined when they are moved at all
// ALONG_NORMALS   defined when they move along the normals of the mesh
//
// PLACES_DIFFER   defined when some of the points lie at the same place
//
// Places          R32UI buffer texture, a point: the id of the first point at the same place, for points
//                 that lie together stay together; with PLACES_DIFFER only
// Displacements   RGBA32F buffer texture, a ring of vectors, RingMask + 1 of them, a power of two; along
//                 normals only the first component counts, and the fourth, which makes reading faster, never
// Amplitude       their unit, in world coordinates
// Normals         RGB32F buffer texture, a point: the unit normal; with ALONG_NORMALS only
//
// With VARIANTS, FirstDisplacement is that of the variant in use, see vtkVoxelMeshVariants.glsl.
//
// The point at place i takes vector i + FirstDisplacement of the ring: Ogayar et al., section III-B.

#ifdef DISPLACED

#ifdef PLACES_DIFFER
uniform usamplerBuffer Places;
#endif
uniform samplerBuffer Displacements;
#ifndef VARIANTS
uniform uint FirstDisplacement;
#endif
uniform uint RingMask;
uniform float Amplitude;
#ifdef ALONG_NORMALS
uniform samplerBuffer Normals;
#endif

// What the displacement of a point depends on, the same for all offsets.
struct MovedPoint
{
  uint Place;
#ifdef ALONG_NORMALS
  vec3 Normal;
#endif
};

MovedPoint movedPoint(uint id)
{
  MovedPoint moved;
#ifdef PLACES_DIFFER
  moved.Place = texelFetch(Places, int(id)).x;
#else
  moved.Place = id;
#endif
#ifdef ALONG_NORMALS
  moved.Normal = texelFetch(Normals, int(id)).xyz;
#endif
  return moved;
}

vec3 displacementOf(MovedPoint moved)
{
  vec3 free = texelFetch(Displacements, int((moved.Place + FirstDisplacement) & RingMask)).xyz;
#ifdef ALONG_NORMALS
  return (Amplitude * free.x) * moved.Normal;
#else
  return Amplitude * free;
#endif
}

vec3 displacementOf(uint id)
{
  return displacementOf(movedPoint(id));
}

#endif
