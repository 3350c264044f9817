// What becomes of the voxels that triangles overlap: their bits are set.
//
// Follows vtkSurfaceWords.glsl.
//
// REMOVE  defined when the bits are cleared instead
// LOOKS   defined when words are looked at first, through the R32UI buffer texture Present over the same
//         words: most triangles of a fine mesh find their bits done, and to look is cheaper than to write.
//         What it shows may be late, since others write meanwhile, but a bit that is done stays so.
// storage buffer 0 holds the words of the slicemap from slice First.z on

#ifdef LOOKS
uniform usamplerBuffer Present;
#endif

layout(std430, binding = 0) buffer Slicemap
{
  uint Words[];
};

bool isDone(Place place)
{
#ifdef LOOKS
  uint present = texelFetch(Present, int(place.Word)).x;
#ifdef REMOVE
  present = ~present;
#endif
  return (present & place.Bit) != 0u;
#else
  return false;
#endif
}

void visit(Facet f, ivec3 local)
{
  Place place = placeOf(f, local);
  if (!isDone(place))
  {
#ifdef REMOVE
    atomicAnd(Words[place.Word], ~place.Bit);
#else
    atomicOr(Words[place.Word], place.Bit);
#endif
  }
}
