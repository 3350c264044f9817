// Kernel of vtkSlicemapExpression: a Boolean expression of slicemaps. See vtkSlicemapQuadKernel.h.
//
// INPUTS       number of slicemaps
// STEPS        statements that declare a uvec4 for each part of the expression, from the inner ones
//              on, in terms of INPUT(i) and of each other
// RESULT       the last of these
// SETS_PADDING defined where the expression is true for voxels that are in no input: then the bits
//              past the end of a row have to be cleared
//
// Inputs       the words of the slicemaps, four a texel
// QuadsPerRow  number of texels of a row
// Columns      number of voxels along x

uniform usamplerBuffer Inputs[INPUTS];
uniform uint QuadsPerRow;
uniform int Columns;

#define INPUT(i) sourceQuad(Inputs[i], quad)

uvec4 kernel(uint quad)
{
  STEPS
#ifdef SETS_PADDING
  uint word = quad % QuadsPerRow * 4u;
  return RESULT &
    uvec4(slicemapRange(word, 0, Columns), slicemapRange(word + 1u, 0, Columns),
      slicemapRange(word + 2u, 0, Columns), slicemapRange(word + 3u, 0, Columns));
#else
  return RESULT;
#endif
}
