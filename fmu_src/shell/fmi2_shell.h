/* What the FMI 2 files share. */
#ifndef THRUSTWASHER_FMI2_SHELL_H
#define THRUSTWASHER_FMI2_SHELL_H

#include "fmi2Functions.h"
#include "shell.h"

/* First line of every function: the instance, if the call is allowed now. */
#define ENTER(function)                      \
    Instance *m = enter(c, CALL_##function); \
    if (!m) return fmi2Error

/* A pointer the host has to give, for n values. */
#define NEED(function, pointer, n) \
    if (is_missing(m, CALL_##function, pointer, n)) return fmi2Error

#endif
