// Fragment shader: the depths of another buffer of the same size, as OpenGL stores depth.
//
// Depth  the buffer

uniform sampler2D Depth;

void main()
{
  gl_FragDepth = texelFetch(Depth, ivec2(gl_FragCoord.xy), 0).r;
}
