/* FMU states: copies of all that decides what comes next, and their bytes.

   A host's pointer is looked for among the states there are, and followed only if it is one: what
   was freed, or the address of a pointer in its place, is refused unread. Instances in any thread
   share these lists. */
#include <stdlib.h>
#include <string.h>

#include "shell.h"

#define FORMAT 2u /* of the bytes; another one is refused */
#define ORDER 0x01020304u

/* Written in front of the numbers; every field is compared before anything is taken over. */
typedef struct {
    char magic[8], guid[WORD_LENGTH];
    uint32_t order, format, check, sizes[13];
} Head;

struct State {
    Head head;
    Snap snap;
};

#define N_LISTS 64 /* by address: a host may keep many states */

typedef struct Living {
    State state; /* in front: the host's pointer */
    struct Living *next;
} Living;

static Living *lists[N_LISTS];
static char locked; /* only while a list is walked */

/* Another compiler than those of the libraries: for hosts with one thread. */
static void lock(void) {
#ifdef __GNUC__
    while (__atomic_test_and_set(&locked, __ATOMIC_ACQUIRE)) continue;
#endif
}

static void unlock(void) {
#ifdef __GNUC__
    __atomic_clear(&locked, __ATOMIC_RELEASE);
#else
    locked = 0;
#endif
}

/* The place of the pointer to a state in its list; the last one, NULL, if there is no such state. */
static Living **place_of(const void *state) {
    Living **p = &lists[(uintptr_t)state / 64 % N_LISTS];
    while (*p && *p != state) p = &(*p)->next;
    return p;
}

static int is_living(const void *state) {
    lock();
    int found = *place_of(state) != NULL;
    unlock();
    return found;
}

static void write_head(Head *head, const Instance *m) {
    const uint32_t sizes[13] = {NPAR,
                                NINP,
                                NSTATE,
                                NOUT,
                                NIOUT,
                                N_VARIABLES,
                                N_SWITCHES,
                                NOWN,
                                NCONT,
                                NMODE,
                                NSIGN,
                                (uint32_t)sizeof(Snap),
                                (uint32_t)sizeof(State)};
    memset(head, 0, sizeof *head);
    memcpy(head->magic, "thrustw3", sizeof head->magic);
    memcpy(head->guid, m->part.guid, sizeof head->guid);
    head->order = ORDER;
    head->format = FORMAT;
    memcpy(head->sizes, sizes, sizeof sizes);
}

/* CRC-32, four bits at a time; of what follows earlier bytes: from their result on. */
uint32_t checksum(uint32_t crc, const unsigned char *bytes, size_t n) {
    static const uint32_t table[16] = {0x00000000u, 0x1db71064u, 0x3b6e20c8u, 0x26d930acu,
                                       0x76dc4190u, 0x6b6b51f4u, 0x4db26158u, 0x5005713cu,
                                       0xedb88320u, 0xf00f9344u, 0xd6d6a3e8u, 0xcb61b38cu,
                                       0x9b64c2b0u, 0x86d3d2d4u, 0xa00ae278u, 0xbdbdf21cu};
    crc = ~crc;
    for (size_t i = 0; i < n; i++) {
        crc = table[(crc ^ bytes[i]) & 15u] ^ (crc >> 4);
        crc = table[(crc ^ (bytes[i] >> 4)) & 15u] ^ (crc >> 4);
    }
    return ~crc;
}

/* Of the numbers and of the head, which has a zero where the result goes. */
static uint32_t check_of(const State *s) {
    Head head = s->head;
    head.check = 0;
    uint32_t crc = checksum(0, (const unsigned char *)&head, sizeof head);
    return checksum(crc, (const unsigned char *)&s->snap, sizeof s->snap);
}

/* The state, if the host's pointer is one; else said, and NULL. */
static State *known(Instance *m, void *state) {
    State *s = state;
    if (!s || !is_living(s)) {
        fail(m, "FMU state = %s, allowed: one that was got before",
             s ? "a pointer that this FMU has not given or has freed" : "none");
    } else if (strcmp(s->head.guid, m->part.guid) != 0) {
        fail(m, "FMU state of another model or version (%.64s), allowed: %s %s", s->head.guid, m->part.name,
             m->part.guid);
    } else if (s->snap.exchange != m->now.exchange) {
        fail(m, "FMU state of an instance for %s, allowed: of one of this instance's kind",
             s->snap.exchange ? "model exchange" : "co-simulation");
    } else {
        return s;
    }
    return NULL;
}

static State *new_state(Instance *m) {
    Living *s = calloc(1, sizeof *s);
    if (!s) {
        fail(m, "%lu bytes of memory are wanted and not to be had", (unsigned long)sizeof *s);
        return NULL;
    }
    write_head(&s->state.head, m);
    lock();
    Living **list = &lists[(uintptr_t)s / 64 % N_LISTS];
    s->next = *list;
    *list = s;
    unlock();
    return &s->state;
}

/* Out of its list, then gone: the first of two threads that free it does so. */
static int drop_state(void *state) {
    lock();
    Living **place = place_of(state), *s = *place;
    if (s) *place = s->next;
    unlock();
    free(s);
    return s != NULL;
}

/* A state that is there already is written over. */
int get_state(Instance *m, void **state) {
    State *s = *state ? known(m, *state) : new_state(m);
    if (!s) return BAD;
    memcpy(&s->snap, &m->now, sizeof s->snap);
    *state = s;
    return GOOD;
}

/* What was refused stays so, though the sentence about it is not part of a state. */
int set_state(Instance *m, void *state) {
    const State *s = known(m, state);
    if (!s) return BAD;
    memcpy(&m->now, &s->snap, sizeof m->now);
    for (int i = 0; i < N_VARIABLES; i++) m->now.refused[i] = m->now.refused[i] ? 2 : 0;
    m->unsolved = m->work_fits = m->table_ready = 0;
    return GOOD;
}

int free_state(Instance *m, void **state) {
    if (!*state) return GOOD;
    if (!drop_state(*state)) {
        known(m, *state); /* says so */
        return BAD;
    }
    *state = NULL;
    return GOOD;
}

int state_size(Instance *m, void *state, size_t *size) {
    if (!known(m, state)) return BAD;
    *size = sizeof(State);
    return GOOD;
}

int write_state(Instance *m, void *state, unsigned char *bytes, size_t size) {
    State *s = known(m, state);
    if (!s) return BAD;
    if (size < sizeof *s) {
        return fail(m, "room for an FMU state = %lu bytes, allowed: %lu and more", (unsigned long)size,
                    (unsigned long)sizeof *s);
    }
    s->head.check = check_of(s);
    memcpy(bytes, s, sizeof *s);
    return GOOD;
}

/* Numbers that no run of this model leaves behind, though the checksum is right. */
static int is_sound(const Snap *s) {
    int refused = 0, good = is_finite(s->time);
    good &= s->mode == INSTANTIATED || s->mode == INITIALIZING || s->mode == STEPPING || s->mode == TERMINATED
            || s->mode == EVENTS || s->mode == CONTINUOUS || s->mode == EXCHANGE_EVENTS;
    good &= s->exchange <= HAS_EXCHANGE && (s->exchange || s->mode < CONTINUOUS);
    good &= (s->dirty == 0 || s->dirty == 1) && (s->prepared == 0 || s->prepared == 1);
    good &= s->n_early >= 0 && is_finite(s->row_end);
    good &= RUN_START < 0 || is_finite(s->par[AT_LEAST_ONE(RUN_START + 1) - 1]);
    good &= s->latch >= 0 && s->latch <= STATUS_NOT_IN_MAP;
    for (int i = 0; i < N_VARIABLES; i++) {
        const Variable *v = &VARIABLES[i];
        refused += s->refused[i] != 0;
        good &= s->refused[i] <= 2;
        if (v->store == STORE_PAR) good &= is_inside(v, s->par[v->slot]);
        if (v->store == STORE_INP) good &= is_inside(v, s->inp[v->slot]);
        if (v->store == STORE_OWN) good &= is_inside(v, s->own[v->slot]);
    }
    for (int i = 0; i < NOUT; i++) good &= is_finite(s->solution.out[i]);
    for (int i = 0; i < NINP; i++) good &= is_finite(s->inp[NINP + i]);
    for (int i = 0; i < NCONT; i++) good &= is_finite(s->cont[i]) && is_finite(s->der[i]);
    for (int i = 0; i < NMODE; i++) good &= is_finite(s->discrete[i]);
    for (int i = 0; i < NSIGN; i++) good &= is_finite(s->sign[i]);
    return good && refused == s->n_refused;
}

/* Why bytes are no state of this FMU; NULL if they are one. */
static const char *reason(const State *s, const Head *mine) {
    if (memcmp(s->head.magic, mine->magic, sizeof mine->magic) != 0) {
        return "bytes that no native thrustwasher FMU has written";
    }
    if (s->head.order != mine->order) return "bytes of a machine with another byte order";
    if (s->head.format != mine->format) return "bytes of another version of the format";
    if (memcmp(s->head.guid, mine->guid, sizeof mine->guid) != 0) {
        return "bytes of another model or version";
    }
    if (memcmp(s->head.sizes, mine->sizes, sizeof mine->sizes) != 0) {
        return "bytes of another layout";
    }
    if (s->head.check != check_of(s)) return "bytes with a wrong checksum; they were changed";
    return is_sound(&s->snap) ? NULL : "bytes with numbers that no run leaves behind";
}

int read_state(Instance *m, const unsigned char *bytes, size_t size, void **state) {
    Head mine;
    write_head(&mine, m);
    if (size != sizeof(State)) {
        return fail(m, "FMU state = %lu bytes, allowed: %lu; truncated, or of another FMU",
                    (unsigned long)size, (unsigned long)sizeof(State));
    }
    State *s = new_state(m);
    if (!s) return BAD;
    memcpy(s, bytes, sizeof *s);
    const char *why = reason(s, &mine);
    if (why) {
        drop_state(s);
        return fail(m, "FMU state = %s; allowed: those of %s %s", why, m->part.name, m->part.guid);
    }
    s->head.check = 0;
    *state = s;
    return GOOD;
}
