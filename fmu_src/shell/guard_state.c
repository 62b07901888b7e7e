/* States: those of an instance, and their bytes, checked in full before Python sees them. */
#include "guard.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    char magic[8], guid[32];
    uint64_t length; /* of everything */
    double time;
    uint32_t mode, check; /* CRC-32 of everything but these last four bytes */
} Header;
static const char MAGIC[8] = "twguard1";

State *guard_find_state(const Guard *g, fmi2FMUstate state) {
    State *found = g->states;
    while (found && found != state) found = found->next;
    return found;
}

State *guard_new_state(Guard *g) {
    State *made = calloc(1, sizeof *made);
    if (made) {
        made->next = g->states;
        g->states = made;
    }
    return made;
}

void guard_free_state(Guard *g, State *state) {
    State **link = &g->states;
    while (*link != state) link = &(*link)->next;
    *link = state->next;
    if (state->inner && g->inner) guard_inner.FreeFMUstate(g->inner, &state->inner);
    free(state);
}

static uint32_t crc(uint32_t sum, const void *data, size_t n) {
    for (const unsigned char *byte = data; n--; byte++) {
        sum ^= *byte;
        for (int bit = 0; bit < 8; bit++) sum = sum >> 1 ^ (sum & 1u ? 0xEDB88320u : 0u);
    }
    return sum;
}

static uint32_t check_of(const fmi2Byte *bytes, size_t size) {
    uint32_t sum = crc(0xFFFFFFFFu, bytes, offsetof(Header, check));
    return ~crc(sum, bytes + sizeof(Header), size - sizeof(Header));
}

size_t guard_header_size(void) { return sizeof(Header); }

void guard_write_header(const State *state, fmi2Byte *bytes, size_t size) {
    Header h = {.length = size, .time = state->time, .mode = state->mode};
    memcpy(h.magic, MAGIC, sizeof h.magic);
    memcpy(h.guid, GUID, sizeof h.guid);
    memcpy(bytes, &h, sizeof h);
    h.check = check_of(bytes, size);
    memcpy(bytes, &h, sizeof h);
}

const char *guard_read_header(State *state, const fmi2Byte *bytes, size_t size) {
    Header h;
    if (size < sizeof h) return "it is too short";
    memcpy(&h, bytes, sizeof h);
    if (memcmp(h.magic, MAGIC, sizeof h.magic)) return "no thrustwasher FMU has written it";
    if (memcmp(h.guid, GUID, sizeof h.guid)) return "another FMU or version has written it";
    if (h.length != size) return "it is not complete";
    if (h.check != check_of(bytes, size)) return "its checksum is wrong: it was changed";
    if (!isfinite(h.time) || !(h.mode & ALWAYS) || (h.mode & (h.mode - 1))) return "it is damaged";
    state->time = h.time;
    state->mode = h.mode;
    return NULL;
}
