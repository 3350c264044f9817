// One place of the addition of numbers that are spread over planes, for all bits of the words at
// once: sum becomes the sum's bits of this place, carry what goes to the next place.

void addPlane(inout uvec4 sum, uvec4 value, inout uvec4 carry)
{
  uvec4 either = sum ^ value;
  uvec4 both = sum & value;
  sum = either ^ carry;
  carry = both | (either & carry);
}

// The same for a subtraction, and what is borrowed from the next place.
void subtractPlane(inout uvec4 difference, uvec4 value, inout uvec4 borrow)
{
  uvec4 either = difference ^ value;
  uvec4 lacks = ~difference & value;
  difference = either ^ borrow;
  borrow = lacks | (~either & borrow);
}

void addPlane(inout uvec2 sum, uvec2 value, inout uvec2 carry)
{
  uvec2 either = sum ^ value;
  uvec2 both = sum & value;
  sum = either ^ carry;
  carry = both | (either & carry);
}
