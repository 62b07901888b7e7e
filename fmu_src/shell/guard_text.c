/* Words: messages to the host, and the path in a resource location. */
#define _GNU_SOURCE
#include "guard.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

/* Copy a text without the two characters that FMI and printf read as commands: hosts differ in
   whether they format what they are given, so the text itself is the format. */
static void plain(const char *text, char *copy, size_t size) {
    size_t n = 0;
    for (; *text && n + 10 < size; text++) {
        const char *instead = *text == '%' ? " percent" : *text == '#' ? "no. " : NULL;
        if (instead) n += (size_t)sprintf(copy + n, "%s", instead);
        else copy[n++] = *text;
    }
    copy[n] = '\0';
}

static void send(Guard *g, fmi2Status status, int category, const char *text) {
    int wanted = status != fmi2OK || (g->wanted & (1u << category | 1u << LOG_ALL));
    char copy[2 * TEXT];
    if (status >= fmi2Discard) g->failed = 1;
    if (!wanted || !g->host.logger) return;
    plain(text, copy, sizeof copy);
    g->host.logger(g->host.componentEnvironment, g->name, status, CATEGORIES[category].name, copy);
}

void guard_say(Guard *g, fmi2Status status, int category, const char *format, ...) {
    char text[TEXT];
    va_list values;
    va_start(values, format);
    vsnprintf(text, sizeof text, format, values);
    va_end(values);
    send(g, status, category, text);
}

int guard_category(const char *name) {
    for (int i = 0; name && i < N_CATEGORIES; i++)
        if (CATEGORIES[i].declared && !strcmp(CATEGORIES[i].name, name)) return i;
    return -1;
}

void guard_pass_on(fmi2ComponentEnvironment g, fmi2String name, fmi2Status status,
                   fmi2String category, fmi2String message, ...) {
    (void)name;
    int known = guard_category(category);
    if (status >= fmi2Discard) status = fmi2Error, known = LOG_ERROR;
    /* pythonfmu writes one line on where it was, then the exception */
    const char *newline = strncmp(message, "Fatal py", 8) ? NULL : strchr(message, '\n');
    send(g, status, known < 0 ? LOG_ALL : known, newline ? newline + 1 : message);
}

/* Replace %xx by bytes, in place; 0 if something else follows a percent sign. */
static int decode(char *text) {
    char *to = text;
    for (const char *from = text; *from; from++) {
        char digits[3] = {0}, *end = digits;
        if (*from != '%') {
            *to++ = *from;
            continue;
        }
        strncpy(digits, from + 1, 2);
        long byte = strchr("+- \t", digits[0]) ? 0 : strtol(digits, &end, 16);
        if (end != digits + 2 || byte == 0) return 0;
        *to++ = (char)byte;
        from += 2;
    }
    *to = '\0';
    return 1;
}

/* The path in file:///x, file:/x, file://localhost/x or in a plain path; NULL if there is none. */
static char *inside(const char *location) {
    int uri = !strncasecmp(location, "file:", 5);
    const char *path = uri ? location + 5 : location;
    if (uri && !strncmp(path, "//", 2)) path = strchr(path + 2, '/');
    while (path && path[0] == '/' && path[1] == '/') path++;
    if (!path || path[0] != '/') return NULL;
    char *copy = strdup(path);
    if (copy && uri && !decode(copy)) {
        free(copy);
        return NULL;
    }
    for (size_t n = copy ? strlen(copy) : 0; n > 1 && copy[n - 1] == '/'; n--) copy[n - 1] = '\0';
    return copy;
}

char *guard_path(const char *location, char *why) {
    char *path = location ? inside(location) : NULL, *module = NULL;
    if (!path) {
        snprintf(why, TEXT, "resource location = %.1500s, allowed: the URI of a folder, "
                 "file:///folder", location ? location : "none");
    } else if (strstr(path, "%20")) { /* pythonfmu takes this for a space, come what may */
        snprintf(why, TEXT, "resource location = %.1500s, allowed: a folder without a percent "
                 "sign and 20 in its name; unpack the FMU elsewhere", location);
    } else if (asprintf(&module, "%s/slavemodule.txt", path) < 0 || access(module, R_OK)) {
        snprintf(why, TEXT, "resource location = %.1500s, allowed: the folder resources of this "
                 "FMU; there is no slavemodule.txt in it", location);
    } else {
        free(module);
        return path;
    }
    free(module);
    free(path);
    return NULL;
}
