/* Not musl's: every processor built for has an instruction. */
#include "libm.h"

#undef sqrt
hidden double sqrt(double);

double sqrt(double x)
{
	return __builtin_sqrt(x);
}
