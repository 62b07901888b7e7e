/* What a script can ask of an FMU, of either version of FMI. Functions return the FMI status. */
#ifndef SCRIPT_H
#define SCRIPT_H

#include <stddef.h>
#include <stdint.h>

#define MOST 256 /* values in a call */

/* RATE, CURVE: derivatives of inputs, of order 1 and 2; in FMI 3 RATE is the value that the host gives
   when it is asked within a step. */
typedef enum { REAL, WHOLE, ENUMERATION, BOOLEAN, RATE, CURVE } Type;

extern const char *resources; /* the folder */

void hear(const char *name, int status, const char *category, const char *text);

void open_library(void *library);
void *make(const char *name, const char *guid, int logging, const char *oddity);
void drop(void *instance);
int set_up(void *instance, double start);
int enter(void *instance, double start);
int leave(void *instance);
int end(void *instance);
int start_over(void *instance);
int put(void *instance, Type type, const uint32_t *references, size_t n, const double *values);
int take(void *instance, Type type, const uint32_t *references, size_t n, double *values);
int step(void *instance, double t, double h);
int choose(void *instance, int on, size_t n, const char *const *categories);
int state_get(void *instance, void **state);
int state_set(void *instance, void *state);
int state_free(void *instance, void **state);
int state_size(void *instance, void *state, size_t *size);
int state_write(void *instance, void *state, void *bytes, size_t size);
int state_read(void *instance, const void *bytes, size_t size, void **state);
int derive(void *instance, int adjoint, const uint32_t *unknowns, size_t n_unknowns,
           const uint32_t *knowns, size_t n_knowns, const double *seed, double *found);
int extra(void *instance, const char *what, const uint32_t *references, size_t n, double *values,
          size_t *n_values);
int call_by_name(void *library, const char *name, void *instance);

/* script_state.c */
int write_file(void *instance, void *state, const char *file);
int read_file(void *instance, void **state, const char *file);
int fuzz(void *instance, void *state, double *counts);
int cycle(const char *guid, int n, double *kilobytes);

#endif
