/* kernel.py once more, so that the shell can be tested without the compiled kernels. */
#include <math.h>
#include <stdlib.h>

#include "kernel.h"

void *tw_memory(size_t size)
{
    return calloc(1, size);
}

void tw_free(void *memory)
{
    free(memory);
}

int tw_rule(const double *par)
{
    if (!(par[0] < par[1]))
        return 1;
    return par[4] > 0.5 && par[5] < 1.5 ? 2 : 0;
}

int tw_derive(double *par)
{
    par[7] = 0.5 * (par[0] + par[1]) * par[3];
    return par[3] == 13.0 ? 14 : 0;
}

int tw_step(double *par, double *inp, double *state, double *work, double *out,
            int32_t *iout, double t, double dt)
{
    double load = inp[0], speed = inp[1], rise = state[0], energy = state[1];
    double coefficient = par[5] > 1.5 ? 0.1 : 0.05 + 0.001 * fabs(speed);
    double slope = par[5] > 1.5 ? 0.0 : copysign(0.001, speed);
    double direction = tanh(speed), torque = par[7] * load * coefficient * direction;
    int n = par[6] > 1.5 ? 10 : 1;
    (void)t;
    for (int i = 0; i < n; i++)
        rise += dt / n * (fabs(torque * speed) - 5.0 * rise) / par[2];
    if (dt > 0.0)
        energy += dt * torque * speed;
    work[0] = n;
    work[1] = par[7] * coefficient * direction;
    work[2] = par[7] * load * (slope * direction + coefficient * (1.0 - direction * direction));
    out[0] = torque, out[1] = inp[2] + rise, out[2] = rise, out[3] = energy;
    out[4] = 3.0 / (1.0 + load / 1000.0);
    iout[0] = fabs(speed) > 50.0 ? 1 : 2;
    iout[1] = rise > 200.0;
    iout[2] = (int32_t)state[2] + (dt > 0.0);
    iout[3] = rise > 200.0 ? 2 : 0;
    if (load > 9000.0) {
        out[0] = 1e30, iout[2] = 99, work[1] = 1e30;
        return 10;
    }
    if (speed == 779.0)
        return -1001;
    if (dt > 0.0)
        state[0] = rise, state[1] = energy, state[2] += 1.0;
    if (speed == 777.0)
        out[0] = NAN;
    return 0;
}

int tw_sens(double *par, double *inp, double *state, double *work, double *seed,
            double *dout)
{
    double ratio = 1.0 + inp[0] / 1000.0;
    (void)par, (void)state;
    if (inp[0] == 5000.0)
        return 11;
    dout[0] = work[1] * seed[0] + work[2] * seed[1];
    dout[1] = seed[2];
    dout[2] = dout[3] = 0.0;
    dout[4] = -0.003 / (ratio * ratio) * seed[0];
    return 0;
}
