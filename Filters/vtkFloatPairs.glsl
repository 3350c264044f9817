// Arithmetic on pairs of floats, for OpenGL without doubles: the value of a pair is the sum of its parts,
// the second at most half a unit in the last place of the first, 48 bits together.
//
// T. J. Dekker: A Floating-Point Technique for Extending the Available Precision. Numerische Mathematik 18
// (1971). Errors are a few units of 2^-48, and none where the result has a pair.
//
// Follows vtkExact.glsl.

vec2 sumOf(float a, float b)
{
  EXACT float sum = a + b;
  EXACT float ofB = sum - a;
  EXACT float ofA = sum - ofB;
  EXACT float error = (a - ofA) + (b - ofB);
  return vec2(sum, error);
}

// The same where b is no larger than a.
vec2 normalized(float a, float b)
{
  EXACT float sum = a + b;
  EXACT float ofB = sum - a;
  EXACT float error = b - ofB;
  return vec2(sum, error);
}

// Twelve bits each.
vec2 halvesOf(float a)
{
  EXACT float scaled = 4097.0 * a;
  EXACT float rest = scaled - a;
  EXACT float high = scaled - rest;
  EXACT float low = a - high;
  return vec2(high, low);
}

vec2 productOf(float a, float b)
{
  vec2 x = halvesOf(a);
  vec2 y = halvesOf(b);
  EXACT float product = a * b;
  EXACT float error = ((x.x * y.x - product) + x.x * y.y + x.y * y.x) + x.y * y.y;
  return vec2(product, error);
}

vec2 add(vec2 a, vec2 b)
{
  vec2 high = sumOf(a.x, b.x);
  vec2 low = sumOf(a.y, b.y);
  EXACT float rest = high.y + low.x;
  vec2 sum = normalized(high.x, rest);
  EXACT float last = sum.y + low.y;
  return normalized(sum.x, last);
}

vec2 subtract(vec2 a, vec2 b)
{
  return add(a, -b);
}

vec2 multiply(vec2 a, vec2 b)
{
  vec2 product = productOf(a.x, b.x);
  EXACT float rest = product.y + (a.x * b.y + a.y * b.x);
  return normalized(product.x, rest);
}

vec2 divide(vec2 a, vec2 b)
{
  // Three digits, of 24 bits.
  float first = a.x / b.x;
  vec2 rest = subtract(a, multiply(b, vec2(first, 0.0)));
  float second = rest.x / b.x;
  rest = subtract(rest, multiply(b, vec2(second, 0.0)));
  float third = rest.x / b.x;
  return add(normalized(first, second), vec2(third, 0.0));
}

bool isLess(vec2 a, vec2 b)
{
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}

vec2 lesser(vec2 a, vec2 b)
{
  return isLess(b, a) ? b : a;
}

vec2 greater(vec2 a, vec2 b)
{
  return isLess(a, b) ? b : a;
}

// The largest integer that is not greater, as a float.
float floorOf(vec2 a)
{
  float whole = floor(a.x);
  return whole == a.x ? whole + floor(a.y) : whole;
}
