/* What the FMI 3 files share. */
#ifndef THRUSTWASHER_FMI3_SHELL_H
#define THRUSTWASHER_FMI3_SHELL_H

#include "fmi3Functions.h"
#include "shell.h"

/* First line of every function: the instance, if the call is allowed now. */
#define ENTER(function)                             \
    Instance *m = enter(instance, CALL_##function); \
    if (!m) return fmi3Error

/* A pointer the host has to give, for n values. */
#define NEED(function, pointer, n) \
    if (is_missing(m, CALL_##function, pointer, n)) return fmi3Error

/* All variables are scalars: as many values as references. */
#define AS_MANY(function, n, n_values) \
    if ((n) != (n_values)) return (fmi3Status)uneven(m, CALL_##function, n, n_values)

/* fmi3_state.c */
/* BAD: the host wants values between communication points that there are not, and it was said. */
int begin_updates(Instance *m, const fmi3ValueReference wanted[], size_t n,
                  fmi3IntermediateUpdateCallback update);
/* Ask the host for the inputs at the end of a step before it is made; they give the rates. */
void ask_ahead(Instance *m, double t, double h);
void show_end(Instance *m); /* Let the host read values at the end of a step. */

static inline int uneven(const Instance *m, int call, size_t n, size_t n_values) {
    return fail(m, "%s: %lu values for %lu scalar variables", CALLS[call].name, (unsigned long)n_values,
                (unsigned long)n);
}

#endif
