// The variants of a mesh that one dispatch does; goes before vtkVoxelMeshDisplacement.glsl.
//
// VARIANTS  defined when there are several: the map to index coordinates and the displacements then are
//           those of the variant in use, else uniforms
//
// Variants  RGBA32UI buffer texture, nine texels a variant, with the rows of vtkVoxelMeshFetch.glsl:
//   0, 1    the first two rows of IndexFromWorld, in single precision
//   2       FirstDisplacement and three words that are not used
//   3 to 8  the three rows of IndexFromWorld, two texels each, each number's lower word first

#ifdef VARIANTS

const int VARIANT_TEXELS = 9;

uniform usamplerBuffer Variants;

uint Variant;
uint FirstDisplacement;
dvec4 IndexFromWorld[3];
vec4 RoughRows[2];

uvec4 texelOfVariant(int texel)
{
  return texelFetch(Variants, int(Variant) * VARIANT_TEXELS + texel);
}

dvec4 exactRow(int row)
{
  uvec4 low = texelOfVariant(3 + 2 * row);
  uvec4 high = texelOfVariant(4 + 2 * row);
  return dvec4(packDouble2x32(low.xy), packDouble2x32(low.zw), packDouble2x32(high.xy),
    packDouble2x32(high.zw));
}

void useVariant(uint variant)
{
  Variant = variant;
#ifdef DISPLACED
  FirstDisplacement = texelOfVariant(2).x;
#endif
  IndexFromWorld[0] = exactRow(0);
  IndexFromWorld[1] = exactRow(1);
  IndexFromWorld[2] = exactRow(2);
}

// As far as it takes for single precision.
void useVariantRoughly(uint variant)
{
  Variant = variant;
#ifdef DISPLACED
  FirstDisplacement = texelOfVariant(2).x;
#endif
  RoughRows[0] = uintBitsToFloat(texelOfVariant(0));
  RoughRows[1] = uintBitsToFloat(texelOfVariant(1));
}

#endif
