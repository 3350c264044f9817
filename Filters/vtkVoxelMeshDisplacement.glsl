// By how much the points of a vtkVoxelMesh are moved; goes before the file that fetches them.
//
// DISPLACED       defined when they are moved at all
// ALONG_NORMALS   defined when they move along the normals of the mesh
//
// Places          R32UI buffer texture, a point: the id of the first point at the same place, for points
//                 that lie together stay together
// Displacements   RGB32F buffer texture, a ring of NumberOfDisplacements vectors in world units; along
//                 normals only the first component counts
// Normals         RGB32F buffer texture, a point: the unit normal; with ALONG_NORMALS only
//
// The point at place i takes vector i + FirstDisplacement of the ring: Ogayar et al. 2022, section III-B.

#ifdef DISPLACED

uniform usamplerBuffer Places;
uniform samplerBuffer Displacements;
uniform uint FirstDisplacement;
uniform uint NumberOfDisplacements;
#ifdef ALONG_NORMALS
uniform samplerBuffer Normals;
#endif

vec3 displacementOf(uint id)
{
  uint place = texelFetch(Places, int(id)).x;
  uint index = (place % NumberOfDisplacements + FirstDisplacement) % NumberOfDisplacements;
  vec3 free = texelFetch(Displacements, int(index)).xyz;
#ifdef ALONG_NORMALS
  return free.x * texelFetch(Normals, int(id)).xyz;
#else
  return free;
#endif
}

#endif
