/* What an FMU reads from its folder resources: part.bin, and for some models a table of numbers.

   A file map-<k>.bin, k from 0 without gaps, has a header of TABLE_HEADER doubles, little-endian as
   on every platform built for: a magic number, how many numbers there are, then the parameters that
   the table was made for. Numbers in single precision follow, then a CRC-32 of all that. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef _WIN32
#include <wchar.h>
#endif

#include "library_file.h"
#include "shell.h"

#if !defined(PART_COMPILED_IN) || (TABLE_ROOM > 0 && !defined(TABLE_COMPILED_IN))
#define READS_FILES
#endif

static int hex(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* Does a text begin with file:, in letters of any size? */
static int is_uri(const char *text) {
    static const char scheme[] = "file:";
    for (int i = 0; scheme[i]; i++) {
        const char c = text[i] >= 'A' && text[i] <= 'Z' ? (char)(text[i] + 'a' - 'A') : text[i];
        if (c != scheme[i]) return 0;
    }
    return 1;
}

/* The path in file:///x, file:/x, file://localhost/x or in a plain path. */
static void take_resources(Instance *m, const char *location) {
    const char *from = location ? location : "";
    int uri = is_uri(from);
    if (uri) from += 5;
    if (uri && !strncmp(from, "//", 2)) {
        const char *host = from + 2;
        from = strchr(host, '/');
        if (!from) from = "";
    }
    if (uri && from[0] == '/' && from[1] && from[2] == ':') from++; /* a drive of Windows */
    size_t n = 0;
    while (*from && n + 1 < PATH_LENGTH) {
        int high = uri && *from == '%' ? hex(from[1]) : -1;
        int low = high >= 0 ? hex(from[2]) : -1;
        m->resources[n++] = low >= 0 ? (char)(16 * high + low) : *from;
        from += low >= 0 ? 3 : 1;
    }
    while (n > 1 && (m->resources[n - 1] == '/' || m->resources[n - 1] == '\\')) n--;
    m->resources[*from ? 0 : n] = '\0'; /* a path that is too long is none */
}

#ifdef READS_FILES
#ifdef _WIN32
/* UTF-8 to UTF-16: the C library takes bytes for letters of its own code page. */
static FILE *open_file(const char *path) {
    wchar_t wide[sizeof((Instance *)0)->resources];
    size_t n = 0;
    for (const unsigned char *c = (const unsigned char *)path; *c && n + 2 < sizeof wide / 2;) {
        int more = *c >= 0xf0 ? 3 : *c >= 0xe0 ? 2 : *c >= 0xc0 ? 1 : 0;
        uint32_t code = more ? *c & (0x3fu >> more) : *c;
        for (c++; more && (*c & 0xc0) == 0x80; more--) code = code << 6 | (*c++ & 0x3fu);
        if (code >= 0x10000u) {
            wide[n++] = (wchar_t)(0xd800u + ((code - 0x10000u) >> 10));
            code = 0xdc00u + ((code - 0x10000u) & 0x3ffu);
        }
        wide[n++] = (wchar_t)code;
    }
    wide[n] = 0;
    return _wfopen(wide, L"rb");
}
#else
static FILE *open_file(const char *path) { return fopen(path, "rb"); }
#endif

/* The file of a name in the folder, which is written behind the folder for as long as that takes. */
static FILE *open_resource(Instance *m, const char *name) {
    const size_t n = strlen(m->resources);
    snprintf(m->resources + n, sizeof m->resources - n, "/%s", name);
    FILE *file = open_file(m->resources);
    m->resources[n] = '\0';
    return file;
}

/* The folder for messages: of a long one the end. */
static const char *shown_folder(const Instance *m) {
    const size_t n = strlen(m->resources), most = TEXT_LENGTH / 2;
    const char *from = m->resources + (n > most ? n - most : 0);
    while ((*from & 0xc0) == 0x80) from++; /* within a letter of UTF-8 */
    return from;
}

/* Is what follows in a file its CRC-32, and then nothing? */
static int is_whole(FILE *file, uint32_t crc) {
    unsigned char end[4];
    if (fread(end, 1, sizeof end, file) != sizeof end || fgetc(file) != EOF) return 0;
    for (int i = 0; i < 4; i++) {
        if (end[i] != (unsigned char)(crc >> 8 * i)) return 0;
    }
    return 1;
}

#endif

#ifdef PART_COMPILED_IN

int load_part(Instance *m, const char *location, const char *guid) {
    take_resources(m, location); /* where there are tables: nothing else is read */
    m->part = COMPILED_PART[0];
    if (guid && !strcmp(guid, m->part.guid)) return GOOD;
    return fail(m,
                "%s: the description has the identifier %s, these sources have %s; they are of "
                "different builds, use both from one FMU",
                m->part.name, guid ? guid : "none", m->part.guid);
}

#else

/* 1: read, 0: damaged or not for this library, -1: there is no such file. */
static int read_part(Instance *m) {
    Part *part = &m->part;
    FILE *file = open_resource(m, "part.bin");
    if (!file) return -1;
    int good = fread(part, sizeof *part, 1, file) == 1
               && is_whole(file, checksum(0, (const unsigned char *)part, sizeof *part))
               && !memcmp(part->magic, "twpart3", sizeof part->magic)
               && !memcmp(part->build, BUILD, sizeof part->build);
    fclose(file);
    part->guid[WORD_LENGTH - 1] = part->name[WORD_LENGTH - 1] = '\0';
    return good;
}

/* Is the part found in the folder resources of the FMU that the library lies in, of the same build? Then
   that folder is taken, and it is said. */
static int is_beside(Instance *m, const char *guid) {
    static const char up[] = "/../../resources";
    char *path = m->resources;
    find_library(path, PATH_LENGTH - sizeof up);
    size_t n = strlen(path);
    while (n > 0 && path[n - 1] != '/' && path[n - 1] != '\\') n--;
    if (n == 0) {
        path[n++] = '.';
    } else if (n > 1) {
        n--; /* without the separator */
    }
    memcpy(path + n, up, sizeof up);
    if (!guid || read_part(m) <= 0 || strcmp(guid, m->part.guid) != 0) return 0;
    Text text = {0};
    add(&text,
        "part.bin of %s is not in the folder of resources that the host names; it is read beside the "
        "library, from %s",
        m->part.name, shown_folder(m));
    tell(&m->log, WARNING, LOG_WARNING, &text);
    return 1;
}

int load_part(Instance *m, const char *location, const char *guid) {
    const Part *part = &m->part;
    take_resources(m, location);
    if (m->resources[0] && read_part(m) > 0 && guid && !strcmp(guid, part->guid)) return GOOD;
    if (is_beside(m, guid)) return GOOD;
    take_resources(m, location);
    if (!m->resources[0]) {
        return fail(m,
                    "the host names no folder of resources (up to %d bytes), from which "
                    "part.bin is read: the FMU's name and start values",
                    PATH_LENGTH - 1);
    }
    int found = read_part(m);
    if (found <= 0) {
        return fail(m, "part.bin in the folder %s is %s; unpack the FMU again", shown_folder(m),
                    found ? "missing" : "damaged, or of another build than this library");
    }
    return fail(m,
                "%s: the description has the identifier %s, part.bin in %s has %s; they are of "
                "different builds, use both from one FMU",
                part->name, guid ? guid : "none", shown_folder(m), part->guid);
}

#endif

#if TABLE_ROOM > 0

static int made_for(const double *table, const double *par) {
    return table[0] == TABLE_MAGIC && memcmp(table + TABLE_PARAMS, par, TABLE_N_PARAMS * sizeof *par) == 0;
}

#ifdef TABLE_COMPILED_IN

static int try_file(Instance *m, int k) {
    double *table = m->work + TABLE_AT;
    if (k > 0) return -1;
    memcpy(table, COMPILED_HEADER, TABLE_HEADER * sizeof *table);
    for (int i = TABLE_HEADER; i < (int)table[TABLE_SIZE]; i++) {
        table[i] = (double)COMPILED_TABLE[i - TABLE_HEADER];
    }
    return made_for(table, m->now.par);
}

#else

/* Read the numbers behind the header; 0 if the file is cut off or damaged. */
static int read_numbers(FILE *file, double *table) {
    double size = table[TABLE_SIZE];
    if (!(size > TABLE_HEADER && size <= TABLE_ROOM)) return 0;
    float part[512];
    uint32_t crc = checksum(0, (const unsigned char *)table, TABLE_HEADER * sizeof *table);
    for (size_t at = TABLE_HEADER, all = (size_t)size; at < all;) {
        size_t n = all - at < 512 ? all - at : 512;
        if (fread(part, sizeof *part, n, file) != n) return 0;
        crc = checksum(crc, (const unsigned char *)part, n * sizeof *part);
        for (size_t i = 0; i < n; i++) {
            table[at + i] = (double)part[i];
            if (!is_finite(table[at + i])) return 0;
        }
        at += n;
    }
    return is_whole(file, crc);
}

/* 1: the file had the table, 0: it had another one, -1: there is no such file, -2: damaged. */
static int try_file(Instance *m, int k) {
    char name[32];
    double *table = m->work + TABLE_AT;
    snprintf(name, sizeof name, "map-%d.bin", k);
    FILE *file = open_resource(m, name);
    if (!file) return -1;
    int found = -2;
    if (fread(table, sizeof *table, TABLE_HEADER, file) == TABLE_HEADER) {
        found = made_for(table, m->now.par) ? read_numbers(file, table) ? 1 : -2 : 0;
    }
    fclose(file);
    if (found != 1) table[0] = 0.0;
    return found;
}

#endif

/* See to it that the table is there if the fidelity wants it. */
int load_table(Instance *m) {
    if (m->table_ready || m->now.par[TABLE_SWITCH] != TABLE_ON) return GOOD;
    m->table_ready = made_for(m->work + TABLE_AT, m->now.par);
    int found = 0;
    for (int k = 0; !m->table_ready && found >= 0 && k < 1000; k++) {
        found = try_file(m, k);
        m->table_ready = found == 1;
    }
    if (m->table_ready) return GOOD;
    m->now.latch = STATUS_BAD_INPUT;
    if (found == -2) return fail(m, "a map in %s is damaged; unpack the FMU again", shown_folder(m));
    return fail(m,
                "fidelity = 'map': no map was made for these parameters; make one with "
                "`thrustwasher map build`, or use fidelity 'field' (looked in %s)",
                shown_folder(m));
}

#else

int load_table(Instance *m) {
    (void)m;
    return GOOD;
}

#endif
