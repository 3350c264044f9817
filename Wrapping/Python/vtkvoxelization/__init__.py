"""VTK classes that voxelize meshes, props and volumes on the graphics processor."""

# Registers VTK's OpenGL classes, of which the rendering classes of the module are made.
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401

from .vtkVoxelization import *  # noqa: F401,F403
