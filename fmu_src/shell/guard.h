/* The guard of a Python FMU: it stands between the host and pythonfmu's library, which checks
   nothing, cannot say "error", and needs a Python that is loaded and ended in the right order. */
#ifndef THRUSTWASHER_GUARD_H
#define THRUSTWASHER_GUARD_H

#include <stddef.h>

#include "fmi2Functions.h"
#include "model.h"

/* The functions of pythonfmu's library that are used. */
#define PYTHONFMU(X) \
    X(Instantiate) X(FreeInstance) X(SetupExperiment) X(EnterInitializationMode) \
    X(ExitInitializationMode) X(Terminate) X(Reset) X(GetReal) X(GetInteger) X(GetBoolean) \
    X(SetReal) X(SetInteger) X(SetBoolean) X(GetFMUstate) X(SetFMUstate) X(FreeFMUstate) \
    X(SerializedFMUstateSize) X(SerializeFMUstate) X(DeSerializeFMUstate) X(DoStep)
#define MEMBER(name) fmi2##name##TYPE *name;
typedef struct { PYTHONFMU(MEMBER) } Pythonfmu;

/* A state: Python's own, and what the guard keeps of it. */
typedef struct State {
    struct State *next;
    fmi2FMUstate inner;
    uint32_t mode;
    double time;
} State;

typedef struct {
    fmi2Component inner;             /* NULL after Python raised where it never should */
    fmi2CallbackFunctions host;      /* a copy: the host's may be gone by now */
    fmi2CallbackFunctions callbacks; /* what pythonfmu is given: everything comes here first */
    char *name, *resources;
    fmi2Boolean visible;
    uint32_t wanted; /* bit i: messages of CATEGORIES[i] that are neither warning nor error */
    uint32_t mode;
    double time;   /* end of the last step that succeeded */
    fmi2Status last_step;
    int failed;    /* an error was logged during this call */
    State *states; /* all that were not freed */
} Guard;

enum { TEXT = 2048 }; /* bytes; longer messages are cut */

/* guard_python.c */
extern Pythonfmu guard_inner;
/* Make the instance; NULL with the reason in `why` (TEXT bytes) if there is no Python, and NULL
   with `why` empty if the slave could not be made, which has been said then. */
fmi2Component guard_start(const Guard *g, char *why);
/* Have a lasting thread state of Python in this thread; 0 if Python has ended. */
int guard_pin(void);
/* Is Python in this process only for FMUs? */
int guard_embeds(void);
/* The Python that runs, for messages: its version and the file it is in. */
const char *guard_version(void);
const char *guard_library(void);
/* Look a symbol up, in all libraries if `in` is NULL, and put it where `target` points. */
int guard_symbol(void *in, const char *name, void *target);

/* guard_find.c */
typedef struct { char library[TEXT], program[TEXT], version[16]; } Found;
/* The shared library of the Python that `python3` starts, that program, its version; or why not. */
int guard_ask_python(Found *found, char *why);
/* Tell the interpreter, before it starts, which program it is, so that it finds that one's packages
   ("": its own choice), and that names are UTF-8. */
void guard_prepare(const char *program);
/* Try in a child process if the interpreter starts: where it cannot, it ends the process. */
int guard_try_python(char *why);

/* guard.c */
/* The instance if this call is allowed now, else NULL, with a message. */
Guard *guard_enter(fmi2Component c, int place);
/* The same for a call that goes on to Python. */
Guard *guard_enter_python(fmi2Component c, int place);
/* What the host gets for what pythonfmu returned. */
fmi2Status guard_leave(Guard *g, fmi2Status status, int place);
void guard_error(Guard *g, int place, const char *what);
#define ENTER(name) \
    Guard *g = guard_enter(c, CALL_fmi2##name); \
    if (!g) return fmi2Error
#define ENTER_PYTHON(name) \
    Guard *g = guard_enter_python(c, CALL_fmi2##name); \
    if (!g) return fmi2Error
#define NEED(condition, name, what) \
    do { \
        if (condition) break; \
        guard_error(g, CALL_fmi2##name, what); \
        return fmi2Error; \
    } while (0)

/* guard_text.c */
/* The place of a category in CATEGORIES, or -1. */
int guard_category(const char *name);
/* Send a message to the host: errors and warnings always, others if they were asked for. */
void guard_say(Guard *g, fmi2Status status, int category, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* What pythonfmu is given as logger. */
void guard_pass_on(fmi2ComponentEnvironment g, fmi2String name, fmi2Status status,
                   fmi2String category, fmi2String message, ...);
/* Decode a resource location into a plain path (to be freed by the caller), or say why not. */
char *guard_path(const char *location, char *why);

/* guard_state.c */
State *guard_find_state(const Guard *g, fmi2FMUstate state);
State *guard_new_state(Guard *g);
void guard_free_state(Guard *g, State *state);
/* The bytes in front of what Python serializes. */
size_t guard_header_size(void);
void guard_write_header(const State *state, fmi2Byte *bytes, size_t size);
/* Check bytes in full and read mode and time; 0 or why they are no state of this FMU. */
const char *guard_read_header(State *state, const fmi2Byte *bytes, size_t size);

#endif
