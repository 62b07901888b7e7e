/* A host that is no Python: runs the commands of standard input on an FMU's library.
   Each command answers "= STATUS values..."; before it come messages, "! STATUS CATEGORY TEXT". */
#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "script.h"

#define SLOTS 8

static void *library, *instances[SLOTS], *states[SLOTS];
static int used;
const char *resources;

void hear(const char *name, int status, const char *category, const char *text)
{
    printf("! %d %s %s %s\n", status, name ? name : "NULL", category, text);
}

static char *word(void) { return strtok(NULL, " \n"); }

static double number(void)
{
    char *text = word();
    return text ? strtod(text, NULL) : NAN;
}

static char *text_or_null(void)
{
    char *text = word();
    return text && strcmp(text, "-") != 0 ? text : NULL;
}

/* The rest of the line: reference, value, reference, value ... or references alone. */
static size_t pairs(uint32_t *references, double *values)
{
    size_t n = 0;
    for (char *text = word(); text && n < MOST; text = word(), n++) {
        references[n] = (uint32_t)strtoul(text, NULL, 10);
        if (values)
            values[n] = number();
    }
    return n;
}

static void answer(int status, const double *values, size_t n)
{
    printf("= %d", status);
    for (size_t i = 0; i < n; i++)
        printf(" %a", values[i]);
    printf("\n");
}

static int type_of(const char *name)
{
    const char *letters = "rwebdc", *found = strchr(letters, name[0]); /* d: derivative, c: curve */
    return found ? (int)(found - letters) : BOOLEAN;
}

static int is_state_command(const char *name, void **m)
{
    static double counts[2];
    if (strcmp(name, "save") == 0)
        answer(state_get(*m, &states[(int)number()]), NULL, 0);
    else if (strcmp(name, "restore") == 0)
        answer(state_set(*m, states[(int)number()]), NULL, 0);
    else if (strcmp(name, "forget") == 0)
        answer(state_free(*m, &states[(int)number()]), NULL, 0);
    else if (strcmp(name, "restore-address") == 0) /* as hosts do that mix up the two */
        answer(state_set(*m, &states[(int)number()]), NULL, 0);
    else if (strcmp(name, "forget-pointer") == 0)
        answer(state_free(*m, states[(int)number()]), NULL, 0);
    else if (strcmp(name, "alias") == 0) {
        int slot = (int)number();
        states[slot] = states[(int)number()];
        answer(0, NULL, 0);
    } else if (strcmp(name, "write") == 0) {
        int slot = (int)number();
        answer(write_file(*m, states[slot], word()), NULL, 0);
    } else if (strcmp(name, "read") == 0) {
        int slot = (int)number();
        answer(read_file(*m, &states[slot], word()), NULL, 0);
    } else if (strcmp(name, "fuzz") == 0) {
        counts[0] = counts[1] = 0.0;
        answer(fuzz(*m, states[(int)number()], counts), counts, 2);
    } else
        return 0;
    return 1;
}

static int is_life_command(const char *name, void **m)
{
    if (strcmp(name, "use") == 0) {
        used = (int)number();
        answer(0, NULL, 0);
    } else if (strcmp(name, "make") == 0) {
        char *title = text_or_null(), *guid = text_or_null();
        int logging = (int)number();
        *m = make(title, guid, logging, word());
        answer(*m ? 0 : 3, NULL, 0);
    } else if (strcmp(name, "drop") == 0) {
        drop(*m);
        *m = NULL;
        answer(0, NULL, 0);
    } else if (strcmp(name, "setup") == 0)
        answer(set_up(*m, number()), NULL, 0);
    else if (strcmp(name, "enter") == 0)
        answer(enter(*m, number()), NULL, 0);
    else if (strcmp(name, "leave") == 0)
        answer(leave(*m), NULL, 0);
    else if (strcmp(name, "end") == 0)
        answer(end(*m), NULL, 0);
    else if (strcmp(name, "reset") == 0)
        answer(start_over(*m), NULL, 0);
    else if (strcmp(name, "step") == 0) {
        double t = number(), h = number();
        answer(step(*m, t, h), NULL, 0);
    } else
        return 0;
    return 1;
}

static void value_command(const char *name, void *m)
{
    static uint32_t references[MOST], knowns[MOST];
    static double values[MOST], found[MOST];
    char *of = word();
    size_t n = MOST;
    if (strcmp(name, "put") == 0) {
        n = pairs(references, values);
        answer(put(m, (Type)type_of(of), references, n, values), NULL, 0);
    } else if (strcmp(name, "take") == 0) {
        n = pairs(references, NULL);
        int rc = take(m, (Type)type_of(of), references, n, found);
        answer(rc, found, rc ? 0 : n);
    } else if (strcmp(name, "derive") == 0) { /* unknown "to" known seed known seed ... */
        references[0] = (uint32_t)strtoul(of, NULL, 10);
        n = pairs(knowns, values);
        int rc = derive(m, 0, references, 1, knowns, n, values, found);
        answer(rc, found, rc ? 0 : 1);
    } else if (strcmp(name, "adjoint") == 0) { /* known, unknown seed unknown seed ... */
        knowns[0] = (uint32_t)strtoul(of, NULL, 10);
        n = pairs(references, values);
        int rc = derive(m, 1, references, n, knowns, 1, values, found);
        answer(rc, found, rc ? 0 : 1);
    } else if (strcmp(name, "call") == 0)
        answer(call_by_name(library, of, m), NULL, 0);
    else if (strcmp(name, "cycle") == 0) {
        int rc = cycle(of, (int)number(), found);
        answer(rc, found, 1);
    } else if (strcmp(name, "choose") == 0) {
        const char *names[MOST];
        for (n = 0; n < MOST && (names[n] = text_or_null());)
            n++;
        answer(choose(m, atoi(of), n, names), NULL, 0);
    } else {
        size_t n_references = pairs(references, NULL);
        int rc = extra(m, of, references, n_references, found, &n);
        answer(rc, found, rc ? 0 : n);
    }
}

int main(int argc, char **argv)
{
    static char line[4096];
    if (argc != 3 || !(library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL))) {
        puts(argc == 3 ? dlerror() : "usage: host LIBRARY RESOURCES < SCRIPT");
        return 2;
    }
    resources = argv[2];
    open_library(library);
    while (fgets(line, sizeof line, stdin)) {
        char *name = strtok(line, " \n");
        void **m = &instances[used];
        if (!name || is_life_command(name, m) || is_state_command(name, m))
            continue;
        value_command(name, *m);
    }
    return dlclose(library) || fflush(stdout) ? 1 : 0;
}
