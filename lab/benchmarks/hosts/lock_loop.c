/* Clutch and plant from two FMUs in a loop of its own: what a host written in C does.
 *
 * lock_loop FMI EXCHANGE STEPS STEP OIL CLUTCH... PLANT... [KIND:REFERENCE ...]
 *
 * CLUTCH and PLANT are library, token, resources and value references: of the clutch speed, load,
 * oil temperature, torque; of the plant slip, load, torque. EXCHANGE is "parallel", "clutch first"
 * or "plant first". KIND:REFERENCE (r, i, b) are values of the clutch to tell at the end. Prints
 * time and slip of every point, then "torque" and the torque, then those values.
 */
#include <dlfcn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2Functions.h"
#include "fmi3Functions.h"

static int fmi;

typedef struct {
    void *library, *instance;
    char **reference; /* of its variables, as the command gives them */
} Unit;

static const char *const LEVELS[] = {"OK", "warning", "discard", "error", "fatal", "pending"};

static void told2(void *host, fmi2String name, fmi2Status status, fmi2String category,
                  fmi2String text, ...) {
    va_list rest;
    va_start(rest, text);
    fprintf(stderr, "%s: %s: ", name, LEVELS[status]);
    vfprintf(stderr, text, rest);
    fprintf(stderr, "\n");
    va_end(rest);
}

static void told3(void *host, fmi3Status status, fmi3String category, fmi3String text) {
    fprintf(stderr, "%s: %s\n", LEVELS[status], text);
}

static const fmi2CallbackFunctions CALLBACKS = {told2, calloc, free, NULL, NULL};

static void *function(Unit *u, const char *name) {
    char full[64];
    snprintf(full, sizeof full, "fmi%d%s", fmi, name);
    void *found = dlsym(u->library, full);
    if (!found) {
        fprintf(stderr, "error: no %s\n", full);
        exit(1);
    }
    return found;
}

static void check(int status, const char *what) {
    if (status > 1) {
        fprintf(stderr, "error: %s returned %s\n", what, LEVELS[status]);
        exit(1);
    }
    if (status == 1) fprintf(stderr, "warning: returned by %s\n", what);
}

/* Call a function of either version. */
#define CALL(u, name2, name3, args2, args3)                                          \
    check(fmi == 2 ? (int)((fmi2##name2##TYPE *)function(u, #name2)) args2           \
                   : (int)((fmi3##name3##TYPE *)function(u, #name3)) args3, #name2)

static double get(Unit *u, unsigned r) {
    double value;
    CALL(u, GetReal, GetFloat64, (u->instance, &r, 1, &value), (u->instance, &r, 1, &value, 1));
    return value;
}

static void put(Unit *u, unsigned r, double value) {
    CALL(u, SetReal, SetFloat64, (u->instance, &r, 1, &value), (u->instance, &r, 1, &value, 1));
}

static void step(Unit *u, double t, double h) {
    fmi3Boolean event, end, early;
    double reached;
    CALL(u, DoStep, DoStep, (u->instance, t, h, fmi2True),
         (u->instance, t, h, fmi3True, &event, &end, &early, &reached));
}

static Unit opened(const char *name, char **given, double stop) {
    Unit u = {dlopen(given[0], RTLD_NOW | RTLD_LOCAL), NULL, given + 3};
    if (!u.library) {
        fprintf(stderr, "error: %s\n", dlerror());
        exit(1);
    }
    if (fmi == 2) {
        u.instance = ((fmi2InstantiateTYPE *)function(&u, "Instantiate"))(
            name, fmi2CoSimulation, given[1], given[2], &CALLBACKS, fmi2False, fmi2True);
    } else {
        u.instance = ((fmi3InstantiateCoSimulationTYPE *)function(&u, "InstantiateCoSimulation"))(
            name, given[1], given[2], fmi3False, fmi3True, fmi3False, fmi3False, NULL, 0, NULL,
            told3, NULL);
    }
    if (!u.instance) {
        fprintf(stderr, "error: %s is not instantiated\n", name);
        exit(1);
    }
    return u;
}

static void start(Unit *u, double stop) {
    if (fmi == 2)
        check(((fmi2SetupExperimentTYPE *)function(u, "SetupExperiment"))(
                  u->instance, fmi2False, 0.0, 0.0, fmi2True, stop), "SetupExperiment");
    CALL(u, EnterInitializationMode, EnterInitializationMode, (u->instance),
         (u->instance, fmi3False, 0.0, 0.0, fmi3True, stop));
}

static unsigned ref(Unit *u, int k) { return (unsigned)strtoul(u->reference[k], NULL, 10); }

enum { SPEED, PRESS, OIL, FRICTION }; /* the clutch's references */
enum { SLIP, LOAD, TORQUE };          /* the plant's */

static void to_clutch(Unit *clutch, double slip, double load) {
    put(clutch, ref(clutch, SPEED), slip);
    put(clutch, ref(clutch, PRESS), load);
}

int main(int count, char **given) {
    if (count < 19) return 2;
    fmi = atoi(given[1]);
    const char *exchange = given[2];
    long steps = atol(given[3]);
    double h = atof(given[4]), stop = steps * h;
    Unit clutch = opened("clutch", given + 6, stop), plant = opened("plant", given + 13, stop);
    put(&clutch, ref(&clutch, OIL), atof(given[5]));
    start(&clutch, stop);
    start(&plant, stop);
    to_clutch(&clutch, get(&plant, ref(&plant, SLIP)), get(&plant, ref(&plant, LOAD)));
    put(&plant, ref(&plant, TORQUE), get(&clutch, ref(&clutch, FRICTION)));
    CALL(&clutch, ExitInitializationMode, ExitInitializationMode, (clutch.instance),
         (clutch.instance));
    CALL(&plant, ExitInitializationMode, ExitInitializationMode, (plant.instance),
         (plant.instance));
    int together = !strcmp(exchange, "parallel"), plant_first = !strcmp(exchange, "plant first");
    printf("0 %.17g\n", get(&plant, ref(&plant, SLIP)));
    for (long k = 0; k < steps; k++) {
        double t = k * h;
        double slip = get(&plant, ref(&plant, SLIP)), load = get(&plant, ref(&plant, LOAD));
        if (together || plant_first) {
            put(&plant, ref(&plant, TORQUE), get(&clutch, ref(&clutch, FRICTION)));
            step(&plant, t, h);
        }
        if (plant_first) {
            slip = get(&plant, ref(&plant, SLIP));
            load = get(&plant, ref(&plant, LOAD));
        }
        to_clutch(&clutch, slip, load);
        step(&clutch, t, h);
        if (!together && !plant_first) {
            put(&plant, ref(&plant, TORQUE), get(&clutch, ref(&clutch, FRICTION)));
            step(&plant, t, h);
        }
        printf("%.17g %.17g\n", (k + 1) * h, get(&plant, ref(&plant, SLIP)));
    }
    printf("torque %.17g\n", get(&clutch, ref(&clutch, FRICTION)));
    for (int k = 19; k < count; k++) {
        unsigned r = (unsigned)strtoul(given[k] + 2, NULL, 10);
        int whole = 0;
        fmi3Boolean yes = 0;
        if (given[k][0] == 'r') {
            printf("%.17g\n", get(&clutch, r));
        } else if (given[k][0] == 'i') {
            CALL(&clutch, GetInteger, GetInt32, (clutch.instance, &r, 1, &whole),
                 (clutch.instance, &r, 1, &whole, 1));
            printf("%d\n", whole);
        } else {
            CALL(&clutch, GetBoolean, GetBoolean, (clutch.instance, &r, 1, &whole),
                 (clutch.instance, &r, 1, &yes, 1));
            printf("%d\n", fmi == 2 ? whole : yes);
        }
    }
    CALL(&clutch, Terminate, Terminate, (clutch.instance), (clutch.instance));
    ((fmi2FreeInstanceTYPE *)function(&clutch, "FreeInstance"))(clutch.instance);
    ((fmi2FreeInstanceTYPE *)function(&plant, "FreeInstance"))(plant.instance);
    return 0;
}
