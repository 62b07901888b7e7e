/* A host that is no Python, but may have loaded its library. Reads calls from standard input, one per line, and prints each with what
   came back: "step 0 1e-3" gives "step 0". What the FMU says is printed as "message STATUS TEXT". */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2Functions.h"

#define CALLS(X) \
    X(GetVersion) X(Instantiate) X(FreeInstance) X(SetupExperiment) X(EnterInitializationMode) \
    X(ExitInitializationMode) X(DoStep) X(GetReal) X(SetReal) X(GetInteger) X(SetInteger) \
    X(GetRealStatus) X(GetBooleanStatus)
#define MEMBER(name) fmi2##name##TYPE *name;

enum { MOST = 256 };
typedef struct {
    CALLS(MEMBER)
    void *library;
    char guid[64], resources[4096];
    fmi2Component c;
} Fmu;
static Fmu fmus[8], *f = fmus;
static char *words[2 * MOST];
static int n_words;

static void logger(fmi2ComponentEnvironment env, fmi2String instance, fmi2Status status,
                   fmi2String category, fmi2String message, ...) {
    (void)env, (void)instance, (void)category;
    printf("message %d %s\n", status, message);
}
static const fmi2CallbackFunctions callbacks = {logger, calloc, free, NULL, NULL};

static double number(int i) { return i < n_words ? strtod(words[i], NULL) : 0.0; }
static unsigned long whole(int i) { return i < n_words ? strtoul(words[i], NULL, 10) : 0; }

static int load(void) { /* LIBRARY GUID RESOURCES, into the slot in use */
    f->library = dlopen(words[1], RTLD_NOW | RTLD_LOCAL);
    if (!f->library) {
        printf("%s\n", dlerror());
        return 9;
    }
#define TAKE(name) *(void **)&f->name = dlsym(f->library, "fmi2" #name);
    CALLS(TAKE)
    snprintf(f->guid, sizeof f->guid, "%s", words[2]);
    snprintf(f->resources, sizeof f->resources, "%s", words[3]);
    return 0;
}

static int unload(void) { return dlclose(f->library); }
static int use(void) { return f = &fmus[whole(1)], 0; }
static int version(void) { return strcmp(f->GetVersion(), "2.0"); }

static int instantiate(void) { /* [logging] */
    f->c = f->Instantiate("host", fmi2CoSimulation, f->guid, f->resources, &callbacks, fmi2False,
                          number(1) != 0.0);
    return f->c == NULL;
}

static int initialize(void) {
    int rc = f->SetupExperiment(f->c, 0, 0.0, 0.0, 0, 0.0);
    rc |= f->EnterInitializationMode(f->c);
    return rc | f->ExitInitializationMode(f->c);
}

static int release(void) {
    f->FreeInstance(f->c);
    f->c = NULL;
    return 0;
}
static int step(void) { return f->DoStep(f->c, number(1), number(2), fmi2True); }
static int steps(void) { /* FIRST COUNT: of 1 ms each */
    int rc = 0, first = (int)number(1), n = (int)number(2);
    for (int i = first; i < first + n; i++) rc |= f->DoStep(f->c, i * 1e-3, 1e-3, fmi2True);
    return rc;
}

/* Values go as "REFERENCE VALUE REFERENCE VALUE ..."; those read are printed. */
#define VALUES(Type, name, format, convert) \
    static int set_##name(void) { \
        fmi2ValueReference vr[MOST] = {0}; \
        fmi2##Type value[MOST] = {0}; \
        size_t n = 0; \
        for (int i = 1; i + 1 < n_words; i += 2, n++) { \
            vr[n] = (fmi2ValueReference)whole(i); \
            value[n] = (fmi2##Type)convert(words[i + 1]); \
        } \
        return f->Set##Type(f->c, vr, n, value); \
    } \
    static int get_##name(void) { \
        fmi2ValueReference vr[MOST] = {0}; \
        fmi2##Type value[MOST] = {0}; \
        size_t n = (size_t)n_words - 1; \
        for (size_t i = 0; i < n; i++) vr[i] = (fmi2ValueReference)whole((int)i + 1); \
        int rc = f->Get##Type(f->c, vr, n, value); \
        for (size_t i = 0; i < n && rc == 0; i++) printf(format " ", value[i]); \
        return rc; \
    }
VALUES(Real, real, "%.17g", atof)
VALUES(Integer, integer, "%d", atol)

static int last(void) { /* prints the last successful time and "terminated" */
    fmi2Real t = -1.0;
    fmi2Boolean ended = 9;
    int rc = f->GetRealStatus(f->c, fmi2LastSuccessfulTime, &t);
    rc |= f->GetBooleanStatus(f->c, fmi2Terminated, &ended);
    return printf("%g %d ", t, ended), rc;
}

#define ENTRY(name) {#name, name},
static const struct { const char *name; int (*call)(void); } COMMANDS[] = {
    ENTRY(load) ENTRY(use) ENTRY(version) ENTRY(instantiate) ENTRY(initialize) ENTRY(release)
    ENTRY(step) ENTRY(steps) ENTRY(set_real) ENTRY(get_real) ENTRY(set_integer) ENTRY(get_integer)
    ENTRY(last) ENTRY(unload)
};

int main(void) {
    static char line[1 << 16];
    while (fgets(line, sizeof line, stdin)) {
        n_words = 0;
        for (char *w = strtok(line, " \n"); w; w = strtok(NULL, " \n")) words[n_words++] = w;
        for (size_t i = 0; n_words && i < sizeof COMMANDS / sizeof COMMANDS[0]; i++) {
            if (strcmp(COMMANDS[i].name, words[0])) continue;
            int rc = COMMANDS[i].call();
            printf("%s %d\n", COMMANDS[i].name, rc);
        }
        fflush(stdout);
    }
    return 0;
}
