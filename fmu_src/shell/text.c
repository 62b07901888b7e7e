/* Sentences, and where they go. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "shell.h"

size_t whole_letters(const char *text, size_t n) {
    const unsigned char *c = (const unsigned char *)text;
    size_t more = 0; /* bytes at the end that continue a letter */
    while (more < n && more < 3 && (c[n - 1 - more] & 0xc0) == 0x80) more++;
    const unsigned char first = more < n ? c[n - 1 - more] : 0;
    const size_t wanted = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : first >= 0xc0 ? 1 : 0;
    return wanted > more ? n - 1 - more : n;
}

static void add_list(Text *t, const char *format, va_list values) {
    size_t room = sizeof t->text - t->n;
    if (t->is_full) return;
    int n = vsnprintf(t->text + t->n, room, format, values);
    t->is_full = n >= 0 && (size_t)n >= room;
    if (n > 0) t->n += t->is_full ? room - 1 : (size_t)n;
    if (t->is_full) t->n = whole_letters(t->text, t->n);
    t->text[t->n] = '\0';
}

void add(Text *t, const char *format, ...) {
    va_list values;
    va_start(values, format);
    add_list(t, format, values);
    va_end(values);
}

/* The decimal sign of the host's language, of one byte or of more, becomes a point. */
static void write_points(Text *t, size_t start) {
    size_t n = start;
    for (size_t i = start; i < t->n; i++) {
        const char c = t->text[i];
        if ((c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || c == '-' || c == '+') {
            t->text[n++] = c;
        } else if (n > start && t->text[n - 1] != '.') {
            t->text[n++] = '.';
        }
    }
    t->text[n] = '\0';
    t->n = n;
}

/* Six digits, and the same everywhere: NaN has no sign. */
void add_number(Text *t, double value) {
    size_t start = t->n;
    if (value != value) {
        add(t, "nan");
        return;
    }
    add(t, "%g", value);
    write_points(t, start);
}

/* As Python writes a float: the fewest digits that give the same number back. */
void add_exact(Text *t, double value) {
    char digits[40];
    int n = 0;
    if (t->is_full) return;
    if (!is_finite(value)) {
        add_number(t, value);
        return;
    }
    do {
        snprintf(digits, sizeof digits, "%.*e", n, value);
    } while (strtod(digits, NULL) != value && ++n < 17);
    int exponent = atoi(strchr(digits, 'e') + 1), decimals = n > exponent ? n - exponent : 1;
    size_t start = t->n;
    if (exponent < -4 || exponent >= 16) {
        add(t, "%.*g", n + 1, value);
    } else {
        add(t, "%.*f", decimals, value);
    }
    write_points(t, start);
}

void add_quantity(Text *t, const Variable *v, double value) {
    add(t, "%s = ", v->name);
    add_number(t, value);
    if (strcmp(v->unit, "1") != 0) add(t, " %s", v->unit);
}

/* Errors and warnings are always sent, the rest when its category is switched on. To FMI 2 a text is
   a format of printf, and # begins a variable: both signs are doubled there. */
void tell(const Log *log, int status, int category, const Text *t) {
    if (!log->send || !log->logger) return;
    if (status == GOOD && !log->on[category] && !log->on[LOG_ALL]) return;
    char text[2 * TEXT_LENGTH], *to = text;
    for (const char *c = t->text; *c; c++) {
        if (log->fmi == 2 && (*c == '%' || *c == '#')) *to++ = *c;
        *to++ = *c;
    }
    *to = '\0';
    log->send(log, status, CATEGORIES[category].name, text);
}

int fail(const Instance *m, const char *format, ...) {
    Text t = {0};
    va_list values;
    va_start(values, format);
    add_list(&t, format, values);
    va_end(values);
    tell(&m->log, BAD, LOG_ERROR, &t);
    return BAD;
}

static int category(const char *name) {
    for (int i = 0; name && i < N_CATEGORIES; i++) {
        if (CATEGORIES[i].declared && strcmp(CATEGORIES[i].name, name) == 0) return i;
    }
    return -1;
}

/* None named: all of them. Switched on, the named ones are the only ones. */
int choose_categories(Instance *m, int on, size_t n, const char *const names[]) {
    for (size_t i = 0; i < n; i++) {
        if (category(names[i]) < 0) {
            const char *name = names[i] ? names[i] : "NULL";
            size_t n = strlen(name);
            if (n > WORD_LENGTH) n = whole_letters(name, WORD_LENGTH);
            return fail(m, "there is no category %.*s of messages in %s", (int)n, name, m->part.name);
        }
    }
    uint8_t *switched = m->log.on;
    if (on || n == 0) memset(switched, on && n == 0, N_CATEGORIES);
    for (size_t i = 0; i < n; i++) switched[category(names[i])] = (uint8_t)(on != 0);
    if (!on) switched[LOG_ALL] = 0;
    return GOOD;
}
