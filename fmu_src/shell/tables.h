/* What a model is, as data: the types of the tables that are generated into model.c. */
#ifndef THRUSTWASHER_TABLES_H
#define THRUSTWASHER_TABLES_H

#include <stdint.h>

/* Where an instance is in its life; the bits of Call.modes and Access. */
enum {
    INSTANTIATED = 1,
    INITIALIZING = 2,
    STEPPING = 4,
    TERMINATED = 8,
    EVENTS = 16,
    UPDATING = 32,
    UPDATED = 64, /* within intermediateUpdate: before a step, after it */
    CONTINUOUS = 128,
    EXCHANGE_EVENTS = 256 /* of model exchange: continuous-time mode, event mode */
};

enum { TYPE_REAL, TYPE_INTEGER, TYPE_BOOLEAN, TYPE_ENUMERATION };
enum { CAUSE_INDEPENDENT, CAUSE_INPUT, CAUSE_PARAMETER, CAUSE_OUTPUT, CAUSE_LOCAL, N_CAUSES };
#define TYPE_BIT(type) (1u << (type))
#define CAUSE_BIT(cause) (16u << (cause))
enum {
    STORE_TIME,
    STORE_PAR,
    STORE_INP,
    STORE_OUT,
    STORE_IOUT,
    STORE_OWN, /* of model exchange: parameters, states, derivatives, event indicators */
    STORE_CONT,
    STORE_DER,
    STORE_SIGN
};

/* A variable; its value reference is its place in VARIABLES. */
typedef struct {
    const char *name, *unit; /* unit "1": a pure number */
    double low, high;        /* the allowed range, both ends belong to it */
    uint32_t depends;        /* outputs: bit i set: input i acts at once, at the same time point */
    uint32_t states;         /* likewise continuous state i */
    int16_t slot;            /* place in its store */
    int16_t enumeration;     /* place in ENUMERATIONS, or -1 */
    uint8_t type, cause, store;
    uint8_t relative; /* a temperature difference, no temperature */
    uint8_t tunable;  /* a parameter that may be set between steps too */
    uint16_t bits;    /* TYPE_BIT of the type and CAUSE_BIT of the causality */
} Variable;

/* What reading and setting look at first, of each variable: small, so that it stays at hand. */
typedef struct {
    uint16_t bits;
    int16_t slot;
} Place;

typedef struct {
    int32_t number;
    const char *name;
} Item;
typedef struct {
    const char *name;
    int32_t n;
    const Item *items;
} Enumeration;

/* A continuous state of model exchange: a size that is usual for it, its place in `out`, or -1. */
typedef struct {
    const char *name;
    double nominal;
    int32_t out;
} ContinuousState;

/* The value a parameter has to have in model exchange. */
typedef struct {
    int32_t slot;
    double value;
    const char *name, *text; /* of the parameter, of its value */
} Requirement;

/* What lets a parameter be used, values of others: all that are required, and one of the rest. */
typedef struct {
    double value;
    int16_t parameter, by; /* places in VARIABLES; by -1: nothing uses it */
    uint8_t relation, required;
    uint8_t follows; /* the other one has to be used itself */
} Condition;
enum { RELATION_IS, RELATION_IS_NOT, RELATION_ABOVE, RELATION_FROM };

/* How a solution was obtained; from FIRST_FAILURE on there is none. */
typedef struct {
    int32_t number;
    const char *name, *advice;
} StatusText;

/* What is said with a status, if the number at `when` is not 0; {k} stands for the unit's number k. */
typedef struct {
    int32_t status, when;
    const char *text;
} Figure;

/* A Boolean output whose changes are events: what happens when it becomes true, then false, and the
   places in `out` of the times [s] of both, -1: not told. */
typedef struct {
    int32_t slot;
    const char *on, *off;
    int32_t instant[2];
} Switch;

/* What the solver counts, and where in `work` the number lies. */
typedef struct {
    const char *text;
    int32_t place;
} Count;

/* What is said when parameters contradict each other; {names} in braces stand for their values. */
typedef struct {
    const char *text;
} Rule;

/* A category of messages; declared: this model's description lists it. */
typedef struct {
    const char *name;
    int32_t declared;
} Category;
enum { LOG_WARNING, LOG_ERROR, LOG_SOLVER, LOG_EVENTS, LOG_ALL, N_CATEGORIES };

/* An FMI function: the modes it is allowed in; declined: why it does nothing, else NULL. */
typedef struct {
    const char *name;
    uint32_t modes;
    const char *declined;
} Call;

/* In which modes the values of a causality may be set, and read. */
typedef struct {
    uint32_t set, get;
} Access;

/* What a type is called in messages, by FMI 2 and 3; the place is that of the enum. */
typedef struct {
    const char *fmi2, *fmi3;
} TypeText;

/* What a mode is called, and the function that leads out of it, without "fmi2", "fmi3". */
typedef struct {
    uint32_t mode;
    const char *name, *leave;
} ModeText;

#endif
