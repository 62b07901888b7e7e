/* What a script does with many states or instances at once. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "script.h"

int write_file(void *instance, void *state, const char *file)
{
    size_t size = 0;
    int rc = state_size(instance, state, &size);
    char *bytes = malloc(size + 1);
    if (rc == 0)
        rc = state_write(instance, state, bytes, size);
    FILE *f = rc == 0 ? fopen(file, "wb") : NULL;
    if (f) {
        fwrite(bytes, 1, size, f);
        fclose(f);
    }
    free(bytes);
    return rc;
}

int read_file(void *instance, void **state, const char *file)
{
    FILE *f = fopen(file, "rb");
    if (!f)
        return 9;
    fseek(f, 0, SEEK_END);
    size_t size = (size_t)ftell(f);
    rewind(f);
    char *bytes = malloc(size + 1);
    size = fread(bytes, 1, size, f);
    fclose(f);
    int rc = state_read(instance, bytes, size, state);
    free(bytes);
    return rc;
}

/* Every byte changed in two ways, every length cut: how many were refused, how many not. */
int fuzz(void *instance, void *state, double *counts)
{
    size_t size = 0;
    if (state_size(instance, state, &size))
        return 3;
    char *good = malloc(size);
    state_write(instance, state, good, size);
    for (size_t i = 0; i < 3 * size; i++) {
        size_t place = i / 3, length = i % 3 == 2 ? place : size;
        char *bytes = malloc(length ? length : 1); /* exact, so that reading on would be seen */
        memcpy(bytes, good, length);
        if (i % 3 < 2)
            bytes[place] ^= i % 3 ? 0x01 : 0xff;
        void *made = NULL;
        int rc = state_read(instance, bytes, length, &made);
        counts[rc == 3 && !made ? 0 : 1]++;
        if (made)
            state_free(instance, &made);
        free(bytes);
    }
    free(good);
    return 0;
}

static long resident(void)
{
    long all = 0, here = 0;
    FILE *f = fopen("/proc/self/statm", "r");
    if (!f || fscanf(f, "%ld %ld", &all, &here) != 2)
        here = -1;
    if (f)
        fclose(f);
    return here * 4;
}

/* Instances made, run and dropped, and how much memory [kB] that took for good. */
int cycle(const char *guid, int n, double *kilobytes)
{
    long before = 0;
    for (int i = 0; i < n; i++) {
        if (i == n / 10)
            before = resident();
        void *m = make("cycle", guid, 0, NULL);
        if (!m)
            return 3;
        if (i % 100 == 0) {
            enter(m, 0.0);
            leave(m);
            step(m, 0.0, 1e-3);
        }
        drop(m);
    }
    *kilobytes = (double)(resident() - before);
    return 0;
}
