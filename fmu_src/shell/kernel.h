/* The model's entries as plain C; each returns the number of a Status, or below 0 for a defect. */
#ifndef THRUSTWASHER_KERNEL_H
#define THRUSTWASHER_KERNEL_H

#include <stddef.h>
#include <stdint.h>

/* Memory for an instance, all 0, NULL if there is none. `par` below is that of an instance in it. */
void *tw_memory(size_t size);
void tw_free(void *memory);
int tw_derive(double *par);
int tw_rule(const double *par); /* 0, or the place (from 1) of the first broken rule in RULES */
/* Behind the inputs lie NRATES rates; models without them (0) do not look there. */
int tw_step(double *par, double *inp, double *state, double *work, double *out, int32_t *iout, double t,
            double dt);
/* `seed`: changes of the inputs, and behind them, if NSEED > NINP, of the tunable parameters. */
int tw_sens(double *par, double *inp, double *state, double *work, double *seed, double *dout);
/* Of model exchange, for an instance in tw_memory: states and what is discrete at the start; outputs,
   derivatives and event indicators; what is discrete anew; changes of outputs and derivatives along
   `along`, changes of inputs and states. Where NEEDS_STEPS: keep the solution of a completed step. */
int tw_start(double *par, double *own, double *inp, double *cont, double *discrete, double *work, double t);
int tw_rates(double *par, double *own, double *inp, double *cont, double *discrete, double *work, double *out,
             double *der, double *sign);
int tw_update(double *par, double *own, double *inp, double *cont, double *discrete, double *work,
              double *out, int32_t *iout, double t);
int tw_finish(double *par, double *own, double *inp, double *cont, double *discrete, double *work, double t);
int tw_slopes(double *par, double *own, double *inp, double *cont, double *discrete, double *work,
              double *along, double *found);

#endif
