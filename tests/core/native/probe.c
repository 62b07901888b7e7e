/* The dispatch of a library without the shell, for tests that look at state and work. */
#include "kernel.h"

#define SHOWN __attribute__((visibility("default")))

SHOWN int probe_derive(double *par)
{
    return tw_derive(par);
}

SHOWN int probe_rule(const double *par)
{
    return tw_rule(par);
}

SHOWN int probe_step(double *par, double *inp, double *state, double *work, double *out,
                     int32_t *iout, double t, double dt)
{
    return tw_step(par, inp, state, work, out, iout, t, dt);
}

SHOWN int probe_sens(double *par, double *inp, double *state, double *work, double *seed,
                     double *dout)
{
    return tw_sens(par, inp, state, work, seed, dout);
}
