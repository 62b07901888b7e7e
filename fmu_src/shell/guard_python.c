/* Python for a process that may have none: load its library where every extension module sees it,
   load pythonfmu's library beside this one, keep thread states, end all in the right order. */
#define _GNU_SOURCE
#include "guard.h"

#include <dlfcn.h>
#include <link.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* FMUs of different models are different libraries with one interpreter to start between them.
   The loader gives a unique symbol one address in the whole process: they share this. C has no word
   for such symbols. All zero is an open lock. */
__asm__(".pushsection .bss\n"
        ".type thrustwasher_shared, @gnu_unique_object\n"
        ".size thrustwasher_shared, 64\n"
        ".balign 64\n"
        "thrustwasher_shared: .zero 64\n"
        ".popsection\n");
typedef struct { pthread_mutex_t lock; int embedded; } Shared;
typedef char fits_in_64_bytes[sizeof(Shared) <= 64 ? 1 : -1];
extern Shared thrustwasher_shared __attribute__((visibility("default")));

Pythonfmu guard_inner;
static struct {
    int (*is_initialized)(void), (*ensure)(void);
    void *(*this_thread)(void), *(*save_thread)(void);
    void (*restore_thread)(void *), (*clear)(void *), (*delete_current)(void);
    const char *(*version)(void);
} python;
static int ready;
static char library[TEXT];
static void (*finalize)(void);
static pthread_key_t own_state;

int guard_symbol(void *in, const char *name, void *target) {
    void *found = dlsym(in ? in : RTLD_DEFAULT, name);
    memcpy(target, &found, sizeof found); /* ISO C has no cast from object to function pointer */
    return found != NULL;
}

int guard_embeds(void) { return thrustwasher_shared.embedded; }
const char *guard_library(void) { return library; }
const char *guard_version(void) { return python.version ? python.version() : ""; }

/* Thread states. Making one costs 10 us, so a thread of a host that is no Python keeps its own.
   In a Python host that started it, every thread that matters has one. */
int guard_pin(void) {
    if (!ready || !python.is_initialized()) return 0;
    if (guard_embeds() && !python.this_thread()) {
        python.ensure();
        pthread_setspecific(own_state, python.save_thread());
    }
    return 1;
}

/* A thread ends. */
static void unpin(void *state) {
    if (!python.is_initialized()) return;
    python.restore_thread(state);
    python.clear(state);
    python.delete_current();
}

/* A libpython that a library of the host has loaded for itself: its name is remembered. */
static int is_libpython(struct dl_phdr_info *info, size_t size, void *name) {
    (void)size;
    if (!strstr(info->dlpi_name, "/libpython3.")) return 0;
    snprintf(name, TEXT, "%s", info->dlpi_name);
    return 1;
}

static void name_library(void) {
    void *symbol = dlsym(RTLD_DEFAULT, "Py_IsInitialized");
    Dl_info info;
    if (dladdr(symbol, &info) && info.dli_fname) snprintf(library, TEXT, "%s", info.dli_fname);
}

/* Have Python's symbols in the global scope, as its extension modules expect. */
static int open_python(char *why) {
    static Found found; /* large; callers hold the lock */
    char reason[TEXT] = "", loaded[TEXT] = "";
    const char *wanted = getenv("FMU_LIBPYTHON");
    if (!dlsym(RTLD_DEFAULT, "Py_IsInitialized")) {
        int answered = guard_ask_python(&found, reason);
        dl_iterate_phdr(is_libpython, loaded);
        if (!wanted || !*wanted) wanted = *loaded ? loaded : answered ? found.library : NULL;
        if (!wanted || !dlopen(wanted, RTLD_NOW | RTLD_GLOBAL)) {
            snprintf(why, TEXT, "no Python is found: %.1500s; install Python with its shared "
                     "library (libpython3.x.so), or set FMU_LIBPYTHON to the path of that file",
                     wanted ? dlerror() : reason);
            return 0;
        }
    }
    if (!(guard_symbol(NULL, "Py_IsInitialized", &python.is_initialized) &&
          guard_symbol(NULL, "PyGILState_Ensure", &python.ensure) &&
          guard_symbol(NULL, "PyGILState_GetThisThreadState", &python.this_thread) &&
          guard_symbol(NULL, "PyEval_SaveThread", &python.save_thread) &&
          guard_symbol(NULL, "PyEval_RestoreThread", &python.restore_thread) &&
          guard_symbol(NULL, "PyThreadState_Clear", &python.clear) &&
          guard_symbol(NULL, "PyThreadState_DeleteCurrent", &python.delete_current) &&
          guard_symbol(NULL, "Py_GetVersion", &python.version))) {
        snprintf(why, TEXT, "%.1500s is no library of Python 3; set FMU_LIBPYTHON to one",
                 wanted ? wanted : "libpython");
        return 0;
    }
    name_library();
    if (python.is_initialized()) return 1;
    if (!*found.version) guard_ask_python(&found, reason);
    int same = !strncmp(guard_version(), found.version, strlen(found.version));
    guard_prepare(same ? found.program : "");
    return guard_try_python(why);
}

/* Before the destructors of pythonfmu's library, which would release the interpreter again. */
static void quit(void) { finalize(); }

/* Load pythonfmu's library, which lies beside this one. Neither is ever unloaded: the handler at
   exit is in this one, and the interpreter's thread runs in the other. */
static int open_pythonfmu(char *why) {
    char place[TEXT + 16];
    Dl_info info;
    int here = dladdr(&guard_inner, &info);
    void *me = here ? dlopen(info.dli_fname, RTLD_NOW | RTLD_NODELETE) : NULL;
    if (!me || dlinfo(me, RTLD_DI_ORIGIN, place)) {
        snprintf(why, TEXT, "this library does not know where it lies");
        return 0;
    }
    strcat(place, "/impl.so");
    void *inner = dlopen(place, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    int complete = inner && guard_symbol(inner, "finalizePythonInterpreter", &finalize);
#define TAKE(name) complete = complete && guard_symbol(inner, "fmi2" #name, &guard_inner.name);
    PYTHONFMU(TAKE)
    if (!complete) {
        snprintf(why, TEXT, "pythonfmu's library cannot be loaded: %.1500s; unpack the FMU again",
                 inner ? place : dlerror());
        return 0;
    }
    return atexit(quit) == 0;
}

/* Python takes some signals over when it starts, Ctrl-C among them; the host shall keep them. */
static void keep_signals(struct sigaction *kept, int back) {
    static const int numbers[] = {SIGINT, SIGPIPE, SIGXFSZ};
    for (int i = 0; i < 3; i++)
        sigaction(numbers[i], back ? &kept[i] : NULL, back ? NULL : &kept[i]);
}

static fmi2Component make(const Guard *g) {
    return guard_inner.Instantiate(g->name, fmi2CoSimulation, GUID, g->resources, &g->callbacks,
                                   g->visible, fmi2True);
}

fmi2Component guard_start(const Guard *g, char *why) {
    struct sigaction kept[3];
    fmi2Component inner = NULL;
    pthread_mutex_lock(&thrustwasher_shared.lock);
    if (!ready) {
        ready = open_python(why) && open_pythonfmu(why) && !pthread_key_create(&own_state, unpin);
    }
    int starts = ready && !python.is_initialized();
    if (starts) {
        thrustwasher_shared.embedded = 1;
        keep_signals(kept, 0);
        inner = make(g); /* under the lock: two threads must not start two interpreters */
        keep_signals(kept, 1);
    }
    pthread_mutex_unlock(&thrustwasher_shared.lock);
    if (ready && !starts && guard_pin()) inner = make(g);
    return inner;
}
