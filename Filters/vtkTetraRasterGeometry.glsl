// Cuts the tetrahedron of a triangle and the origin by slices: Ogayar et al., section III-A and III-B.
//
// Follows vtkExact.glsl.
//
// SLICES       number of slices that an invocation does; MAX_VERTICES is four times as many
// LAYERED      defined when slices are layers of the render target; else there is one slice
//
// Origin       common corner of all tetrahedra, in the coordinates that corners have
// TileFirst    the column at pixel (0, 0), relative to the anchor
// TileSize     size of the viewport in pixels, powers of two
// FirstSlice   the slice of the first layer, relative to the anchor
// EndSlice     the slice behind the last one
//
// Instance i does the slices from FirstSlice + i * SLICES on. A slice meets a tetrahedron that has corners
// below it and others that are not; the section is spanned by the points where edges from the former to the
// latter meet the slice. Both tetrahedra at a facet see the same two points of it, to the last bit, hence
// EXACT; they are snapped to 1/128 of a voxel, and moved by half of that, so that no edge along an axis
// goes through a pixel's centre: what lies on the upper end of a section is in it, on the lower end not.

layout(triangles) in;
layout(triangle_strip, max_vertices = MAX_VERTICES) out;

flat in vec3 Corner[];
flat in int Instance[];

uniform vec3 Origin;
uniform ivec2 TileFirst;
uniform ivec2 TileSize;
uniform int FirstSlice;
uniform int EndSlice;

const float SUBPIXELS = 128.0;

void emitPoint(vec3 below, vec3 above, int slice)
{
  EXACT float share = (float(slice) - below.z) / (above.z - below.z);
  EXACT vec2 point = below.xy + share * (above.xy - below.xy);
  vec2 snapped = (floor(point * SUBPIXELS + 0.5) + 0.5) / SUBPIXELS;
  vec2 pixel = snapped - vec2(TileFirst) + 0.5;
#ifdef LAYERED
  gl_Layer = slice - FirstSlice;
#endif
  gl_Position = vec4(2.0 * pixel / vec2(TileSize) - 1.0, 0.0, 1.0);
  EmitVertex();
}

void main()
{
  vec3 corners[4] = vec3[4](Corner[0], Corner[1], Corner[2], Origin);
  vec4 heights = vec4(Corner[0].z, Corner[1].z, Corner[2].z, Origin.z);
  float lowest = min(min(heights.x, heights.y), min(heights.z, heights.w));
  float highest = max(max(heights.x, heights.y), max(heights.z, heights.w));
  int first = FirstSlice + Instance[0] * SLICES;
  int end = min(first + SLICES, EndSlice);
  first = max(first, int(clamp(floor(lowest) + 1.0, float(first), float(end))));
  end = int(clamp(floor(highest) + 1.0, float(first), float(end)));
  for (int slice = first; slice < end; ++slice)
  {
    // The corners below the slice come first.
    vec3 sorted[4];
    int below = 0;
    for (int i = 0; i < 4; ++i)
    {
      if (corners[i].z < float(slice))
      {
        sorted[below++] = corners[i];
      }
    }
    int next = below;
    for (int i = 0; i < 4; ++i)
    {
      if (!(corners[i].z < float(slice)))
      {
        sorted[next++] = corners[i];
      }
    }
    for (int i = 0; i < below; ++i)
    {
      for (int j = below; j < 4; ++j)
      {
        emitPoint(sorted[i], sorted[j], slice);
      }
    }
    EndPrimitive();
  }
}
