/* One running model: memory, checks, lazy outputs, steps. Knows no FMI type and no physics. */
#ifndef THRUSTWASHER_SHELL_H
#define THRUSTWASHER_SHELL_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "model.h"

#define AT_LEAST_ONE(n) ((n) > 0 ? (n) : 1) /* C has no empty arrays */
#define TEXT_LENGTH 1024
#define PATH_LENGTH 4096
#define NAME_LENGTH 128
#define WORD_LENGTH 64

/* What functions return: the numbers are those of fmi2Status and fmi3Status. */
enum { GOOD = 0, WARNING = 1, DISCARD = 2, BAD = 3 };

/* What a step changes. */
typedef struct {
    double state[AT_LEAST_ONE(NSTATE)], out[AT_LEAST_ONE(NOUT)];
    int32_t iout[AT_LEAST_ONE(NIOUT)];
} Solution;

/* All that decides what comes next: an FMU state is a copy of it. */
typedef struct {
    double par[NPAR], inp[2 * AT_LEAST_ONE(NINP)], time; /* inputs, then their rates [unit/s] */
    Solution solution;
    uint32_t mode;
    int32_t latch;                /* the failure to be seen in solver_status until something changes */
    int32_t dirty;                /* the outputs are not those of the present values */
    int32_t prepared;             /* rules checked and derived constants computed */
    int32_t n_refused;            /* inputs, parameters whose last value was not taken over ... */
    int32_t n_early;              /* early returns in a row, which began with a step to ... */
    double row_end;               /* ... this time [s] */
    int32_t seen[N_SWITCHES + 1]; /* Boolean outputs at the last communication point */
    uint8_t refused[N_VARIABLES]; /* ... 1: by the refusal kept as a text, 2: by an earlier one */
    uint8_t exchange;             /* made for model exchange: then these count in place of `state` */
    double own[AT_LEAST_ONE(NOWN)], cont[AT_LEAST_ONE(NCONT)], der[AT_LEAST_ONE(NCONT)];
    double discrete[AT_LEAST_ONE(NMODE)], sign[AT_LEAST_ONE(NSIGN)]; /* [0]: the next time event [s] */
} Snap;

/* Where messages go. */
typedef struct Log {
    void (*send)(const struct Log *log, int status, const char *category, const char *text);
    void (*logger)(void); /* the host's, whatever its type; may be NULL */
    void *environment;
    int32_t fmi; /* the version: 2 or 3 */
    char name[NAME_LENGTH];
    uint8_t on[N_CATEGORIES];
} Log;

/* What an FMU says of its own, beside the library that all of its model share: the file part.bin,
   little-endian as every platform built for, with a CRC-32 behind it. */
typedef struct {
    char magic[8], build[16], guid[WORD_LENGTH], name[WORD_LENGTH];
    double starts[N_VARIABLES];
    double ranges[2][AT_LEAST_ONE(NINP)][2]; /* of each input: the part's box, what was verified */
    double step;                             /* of the default experiment [s] */
} Part;

/* In C sources the part is compiled in, in place of part.bin (PART_COMPILED_IN); where a model has
   nothing but a table, that one too, header and numbers (TABLE_COMPILED_IN). */
extern const Part COMPILED_PART[];
extern const double COMPILED_HEADER[];
extern const float COMPILED_TABLE[];

typedef struct {
    Snap now;
    Solution undo;
    double given[2 * AT_LEAST_ONE(NINP)]; /* the inputs and rates of the last solve */
    double both[AT_LEAST_ONE(NINP)][2];   /* of each input: what both ranges of the part have in common */
    Log log;
    Part part;
    int32_t unsolved;  /* the failure of the solve at the present values, or 0 */
    int32_t warned;    /* the status the host was last told, -1: nothing yet */
    int32_t told_late; /* the host was told that a step did not begin where the last one ended */
    int32_t told_long; /* ... that its step is too long */
    uint8_t told_zero[AT_LEAST_ONE(NINP)]; /* the host was told that this input at 0 K keeps its last value */
    uint8_t beyond[2][AT_LEAST_ONE(NINP)]; /* the inputs that are outside their ranges ... */
    uint32_t left[2][AT_LEAST_ONE(NINP)];  /* ... and how often they left them in this run */
    uint32_t cared[FIRST_FAILURE];         /* how often a solution began to need care, by its status */
    double engaged[FIRST_FAILURE];         /* in which engagement a status with figures was told last */
    int32_t work_fits;                     /* `work` belongs to the present solution */
    int32_t last_step;                     /* what the last step returned */
    int32_t has_events;                    /* the host goes through event mode; FMI 3 only */
    Solution *before;           /* ... and lets steps end early: room for the solution at a step's start */
    int32_t happened, is_early; /* of the last step: a Boolean output changed, it ended early */
    void (*update)(void);       /* the host's intermediateUpdate, or NULL; FMI 3 only ... */
    int32_t asks, shows;        /* ... it is called for inputs before a step, to read after it */
    int32_t table_ready;        /* the table in `work` is that of the present parameters, or not wanted */
    char resources[PATH_LENGTH + WORD_LENGTH]; /* the folder, in UTF-8; room for a file's name */
    char refusal[TEXT_LENGTH];
    double along[AT_LEAST_ONE(NINP + NCONT)], found[AT_LEAST_ONE(NOUT + NCONT)]; /* of a derivative */
    double discrete[AT_LEAST_ONE(NMODE)]; /* what is to be put back if an update fails */
    double work[AT_LEAST_ONE(NWORK)];     /* carries nothing between calls, the table aside */
} Instance;

/* How a host hands over values: which types of variables, in which form. */
typedef struct {
    const char *name;
    uint32_t takes;
    int form;
} Kind;
enum { FORM_DOUBLE, FORM_INT32, FORM_INT64, FORM_BYTE, FORM_NONE };

/* lifecycle.c */
/* Switched on: every category. */
void name_log(Log *log, const char *name, int on, int fmi);
/* `ends_early`: steps may end at events, which takes memory for another solution. */
Instance *instantiate(const Log *log, const char *guid, const char *resources, int ends_early);
void free_instance(void *instance);
/* NULL: not allowed now, and said so. In the modes between the initialization and the end most calls are
   allowed at a look; a mode of one kind of interface says that the call is of that kind. */
Instance *enter_slowly(void *instance, int call);
static inline Instance *enter(void *instance, int call) {
    Instance *m = instance;
    const uint32_t running = STEPPING | EVENTS | CONTINUOUS | EXCHANGE_EVENTS;
    if (m && CALLS[call].modes & m->now.mode & running && !CALLS[call].declined) return m;
    return enter_slowly(instance, call);
}
int begin(Instance *m, double start_time);
int leave_initialization(Instance *m);
int reset(Instance *m);
int advance(Instance *m, double t, double h);

/* exchange_solution.c */
int solve_exchange(Instance *m);
int update_exchange(Instance *m);
int finish_step(Instance *m);

/* exchange.c: model exchange, whose states are the host's */
/* NULL, and said so, also where this model is for co-simulation only. */
Instance *instantiate_exchange(const Log *log, const char *guid, const char *resources);
int set_time(Instance *m, double t);
int set_continuous(Instance *m, int call, const double *states, size_t n);
int get_exchanged(Instance *m, int call, const double *from, size_t there, double *to, size_t n);
int get_nominals(Instance *m, int call, double *nominals, size_t n);
int enter_event_mode(Instance *m);
/* Update what is discrete; *next: the next time event [s], past all times if there is none. */
int update_discrete(Instance *m, double *next);
int complete_step(Instance *m);

/* events.c */
int has_changed(const Instance *m); /* a Boolean output, since the last communication point */
int follow_to_event(Instance *m, double t, double *h); /* as `follow`; *h may get shorter */

/* By the bits: NaN raises no exception here, even where the host has unmasked them. */
static inline int is_finite(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits << 1 < (uint64_t)0x7ff << 53;
}

/* By the compiler, not by a function that a host could have one of its own of. */
static inline double size_of(double x) { return __builtin_fabs(x); }

/* solution.c */
int prepare(Instance *m);
int refresh(Instance *m);
int solve(Instance *m, double t, double h); /* 0 or a failure, which changes nothing */
/* Outputs, memory, inputs as before the last solve; memory that is large: if h was 0. */
void put_back(Instance *m);
void note_states(Instance *m, double h);     /* of model exchange, after a step of h; 0: at the start */
int follow(Instance *m, double t, double h); /* as solve, h > 0, along the inputs' rates */

/* resource.c */
int load_part(Instance *m, const char *location, const char *guid); /* BAD: and said so */
int load_table(Instance *m); /* BAD: the fidelity wants a table that is not there, and said so */

/* values.c */
int set_values(Instance *m, int call, const uint32_t *references, size_t n, const Kind *kind,
               const void *values);
int get_values(Instance *m, int call, const uint32_t *references, size_t n, const Kind *kind, void *values);
/* Rates of inputs for the next step; `orders` of derivatives, of which there is the first. */
int set_rates(Instance *m, int call, const uint32_t *references, size_t n, const int32_t *orders,
              const double *rates);
int is_missing(Instance *m, int call, const void *array, size_t n);
const Variable *find(Instance *m, uint32_t reference);

static inline double value_of(const Instance *m, const Variable *v) {
    const Snap *s = &m->now;
    switch (v->store) {
    case STORE_OUT: return s->solution.out[v->slot];
    case STORE_INP: return s->inp[v->slot];
    case STORE_PAR: return s->par[v->slot];
    case STORE_OWN: return s->own[v->slot];
    case STORE_CONT: return s->cont[v->slot];
    case STORE_DER: return s->der[v->slot];
    case STORE_SIGN: return s->sign[v->slot];
    case STORE_IOUT: return s->latch && v->slot == IO_STATUS ? s->latch : s->solution.iout[v->slot];
    default: return s->time;
    }
}

/* A table is for one set of parameters: with it none of them can be tuned. */
static inline int has_table_for(const Instance *m, const Variable *v) {
#if TABLE_ROOM > 0
    return m->now.par[TABLE_SWITCH] == TABLE_ON && v->slot < TABLE_N_PARAMS;
#else
    (void)m, (void)v;
    return 0;
#endif
}

/* The continuous state that a variable is, or -1. */
static inline int state_of(const Variable *v) {
    if (v->store == STORE_CONT) return v->slot;
    for (int i = 0; v->store == STORE_OUT && i < NCONT; i++) {
        if (CONTINUOUS_STATES[i].out == v->slot) return i;
    }
    return -1;
}

static inline int may_set(const Instance *m, const Variable *v) {
    return (ACCESS[v->cause].set & m->now.mode)
           || (v->tunable && m->now.mode & (STEPPING | EVENTS | EXCHANGE_EVENTS) && !has_table_for(m, v));
}

/* A finite value outside a range by a rounding error is the end of the range: some units in the last
   place of the larger end, and at most 1e-9 of the range. */
static inline double within(double low, double high, double value) {
    if (!is_finite(value) || (low <= value && value <= high)) return value;
    const double end = value < low ? low : high, least = size_of(low), most = size_of(high);
    const double scale = is_finite(high - low) ? least < most ? most : least : size_of(end);
    const double range = 1e-9 * (high - low), ulps = 0x1p-49 * scale, room = ulps < range ? ulps : range;
    return size_of(value - end) <= room ? end : value;
}

static inline int is_inside(const Variable *v, double value) {
    return is_finite(value) && v->low <= value && value <= v->high;
}

/* state.c */
typedef struct State State;
uint32_t checksum(uint32_t crc, const unsigned char *bytes, size_t n);
int get_state(Instance *m, void **state);
int set_state(Instance *m, void *state);
int free_state(Instance *m, void **state);
int state_size(Instance *m, void *state, size_t *size);
int write_state(Instance *m, void *state, unsigned char *bytes, size_t size);
int read_state(Instance *m, const unsigned char *bytes, size_t size, void **state);

/* derivative.c; knowns are inputs (or parameters, see there), unknowns Real outputs */
typedef struct {
    const uint32_t *unknowns, *knowns;
    size_t n_unknowns, n_knowns;
    const double *seed;
} Direction;
int directional(Instance *m, const Direction *d, double *sensitivity);
int adjoint(Instance *m, const Direction *d, double *sensitivity);
/* exchange_derivative.c: knowns are inputs and continuous states, unknowns outputs and derivatives */
int exchange_directional(Instance *m, const Direction *d, double *sensitivity);
int exchange_adjoint(Instance *m, const Direction *d, double *sensitivity);

/* text.c: sentences that grow piece by piece, and are cut between letters where the memory ends */
typedef struct {
    size_t n;
    int is_full;
    char text[TEXT_LENGTH];
} Text;
size_t whole_letters(const char *text, size_t n); /* at most n bytes of UTF-8: no letter is cut */
void add(Text *t, const char *format, ...);
void add_number(Text *t, double value);
void add_exact(Text *t, double value);
void add_quantity(Text *t, const Variable *v, double value); /* name = number unit */
void tell(const Log *log, int status, int category, const Text *t);
int fail(const Instance *m, const char *format, ...); /* says it as an error and returns BAD */
int choose_categories(Instance *m, int on, size_t n, const char *const names[]);

/* messages.c: what is said about a run */
void tell_failure(const Instance *m, int32_t status, double t, double h);
void tell_rule(const Instance *m, const char *rule);
void tell_refusal(Instance *m, const Variable *v, double value);
void tell_late_step(Instance *m, double t, double h, double expected);
void tell_long_step(Instance *m, double h);
void tell_no_temperature(Instance *m, const Variable *v);
void tell_switches(Instance *m);
void tell_effort(const Instance *m);
void tell_advice(Instance *m);
void tell_counts(const Instance *m);
const StatusText *status_text(int32_t status);

#endif
