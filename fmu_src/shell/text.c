/* Sentences, and where they go. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "shell.h"

static void add_list(Text *t, const char *format, va_list values) {
    size_t room = sizeof t->text - t->n;
    int n = vsnprintf(t->text + t->n, room, format, values);
    if (n > 0) t->n += (size_t)n < room ? (size_t)n : room - 1;
}

void add(Text *t, const char *format, ...) {
    va_list values;
    va_start(values, format);
    add_list(t, format, values);
    va_end(values);
}

/* A decimal comma of the host's language becomes a point. */
static void write_points(Text *t, size_t start) {
    for (; start < t->n; start++) {
        if (t->text[start] == ',') t->text[start] = '.';
    }
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

/* Errors and warnings are always sent, the rest when its category is switched on. */
void tell(const Log *log, int status, int category, const Text *t) {
    if (!log->send || !log->logger) return;
    if (status == GOOD && !log->on[category] && !log->on[LOG_ALL]) return;
    char text[TEXT_LENGTH];
    memcpy(text, t->text, sizeof text);
    for (char *c = text; *c; c++) {
        if (*c == '#') *c = '.'; /* FMI 2 gives it a meaning */
    }
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
            return fail(m, "there is no category %.64s of messages in %s",
                        names[i] ? names[i] : "NULL", m->part.name);
        }
    }
    uint8_t *switched = m->log.on;
    if (on || n == 0) memset(switched, on && n == 0, N_CATEGORIES);
    for (size_t i = 0; i < n; i++) switched[category(names[i])] = (uint8_t)(on != 0);
    if (!on) switched[LOG_ALL] = 0;
    return GOOD;
}
