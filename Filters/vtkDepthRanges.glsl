// Fragment shader: a pair of depth buffers becomes the voxels between them, one pixel a column.
// Follows vtkDepthRange.glsl.

out uint Range;

void main()
{
  Range = rangeOf(ivec2(gl_FragCoord.xy));
}
