// A fragment flips a voxel, by the logic operation XOR.

out uint Flip;

void main()
{
  Flip = 1u;
}
