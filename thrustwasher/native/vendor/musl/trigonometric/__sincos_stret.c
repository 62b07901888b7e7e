/* Not musl's: what compilers for macOS call for a sine and a cosine. */
#include "libm.h"

struct both { double sin, cos; };
hidden struct both __sincos_stret(double);

struct both __sincos_stret(double x)
{
	struct both y;
	sincos(x, &y.sin, &y.cos);
	return y;
}
