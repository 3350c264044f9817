// Sets the voxels of a column that a triangle touches: Eisemann & Decoret 2008, section 5.3, with the
// depth range of the triangle in the column exact. Combined by the logic operation OR.
//
// Follows vtkSolidMasks.glsl and, in single precision, vtkTouchedColumn.glsl.
//
// TileFirst, HalfWidth as in vtkTouchedRasterVertex.glsl
// FirstSlice           the slice at bit 0 of the first target, relative to the anchor
// NumberOfSlices       slices of the pass

uniform ivec2 TileFirst;
uniform float HalfWidth;
uniform int FirstSlice;
uniform int NumberOfSlices;

flat in vec3 A;
flat in vec3 B;
flat in vec3 C;

void main()
{
  vec2 column = floor(gl_FragCoord.xy) + vec2(TileFirst);
  Row row = rowOf(A, B, C, column.y, HalfWidth);
  Range depths = depthsInColumn(A, B, C, row, column.x, HalfWidth);
  if (depths.Low > depths.High)
  {
    discard;
  }
  float slices = float(NumberOfSlices);
  int first = int(clamp(ceil(depths.Low - HalfWidth) - float(FirstSlice), 0.0, slices));
  int end = int(clamp(floor(depths.High + HalfWidth) + 1.0 - float(FirstSlice), 0.0, slices));
  for (int target = 0; target < TARGETS; ++target)
  {
    Masks[target] = slicesFrom(first, target) & ~slicesFrom(end, target);
  }
}
