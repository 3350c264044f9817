// EXACT keeps a compiler from rearranging a sum, where OpenGL can tell it so. Goes first of all, for an extension.

#extension GL_ARB_gpu_shader5 : enable
#ifdef GL_ARB_gpu_shader5
#define EXACT precise
#else
#define EXACT
#endif
