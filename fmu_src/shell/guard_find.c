/* Which Python: the one that `python3` starts, as the embedded interpreter takes its packages from
   there. Both looks are made in child processes, where nothing can harm the host. */
#define _GNU_SOURCE
#include "guard.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#include <wchar.h>

extern char **environ;

enum { PATIENCE = 30000 }; /* ms until a child that says nothing is given up */

/* Prints the shared library (an empty line if there is none), the program, the version. */
static char QUESTION[] =
    "import os, sys, sysconfig\n"
    "get = lambda name: sysconfig.get_config_var(name) or ''\n"
    "name = get('INSTSONAME')\n"
    "folders = [get('LIBDIR'), os.path.join(get('LIBDIR'), get('MULTIARCH')),\n"
    "           os.path.join(sys.base_prefix, 'lib')]\n"
    "found = [os.path.join(folder, name) for folder in folders]\n"
    "found = [path for path in found if os.path.isfile(path)] + [name]\n"
    "print(found[0] if '.so' in name else '')\n"
    "print(sys.executable)\n"
    "print('%d.%d.' % sys.version_info[:2])\n";

/* Read what a child writes until it ends; one that hangs is ended. */
static void listen_to(pid_t child, int end, char *text) {
    size_t n = 0;
    ssize_t got = -1;
    struct pollfd watched = {end, POLLIN, 0};
    while (n + 1 < TEXT) {
        int rc = poll(&watched, 1, PATIENCE);
        if (rc > 0) got = read(end, text + n, TEXT - 1 - n);
        else if (rc == 0 || errno != EINTR) break;
        else continue;
        if (got > 0) n += (size_t)got;
        else if (got == 0 || errno != EINTR) break;
    }
    text[n] = '\0';
    close(end);
    if (got != 0) kill(child, SIGKILL);
    while (waitpid(child, NULL, 0) < 0 && errno == EINTR) {}
}

/* Put the question to `python3`; 0 or an error number. */
static int ask(char *answer) {
    int ends[2];
    pid_t child;
    if (pipe2(ends, O_CLOEXEC)) return errno;
    char name[] = "python3", option[] = "-c", *argv[] = {name, option, QUESTION, NULL};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, ends[1], 1);
    posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    int rc = posix_spawnp(&child, name, &actions, NULL, argv, environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    if (rc) close(ends[0]);
    else listen_to(child, ends[0], answer);
    return rc;
}

int guard_ask_python(Found *found, char *why) {
    char answer[TEXT], *lines[3] = {answer};
    int rc = ask(answer);
    for (int i = 0; !rc && i < 3; i++) {
        char *end = lines[i] ? strchr(lines[i], '\n') : NULL;
        if (end) *end = '\0';
        else rc = -1;
        if (i < 2) lines[i + 1] = end ? end + 1 : NULL;
    }
    if (rc) {
        snprintf(why, TEXT, "%s", rc > 0 ? "there is no python3 on PATH"
                                         : "python3 on PATH does not run (python3 -V tells why)");
        return 0;
    }
    snprintf(found->library, TEXT, "%s", lines[0]);
    snprintf(found->program, TEXT, "%s", lines[1]);
    snprintf(found->version, sizeof found->version, "%s", lines[2]);
    if (!*lines[0]) snprintf(why, TEXT, "%s has no shared library", lines[1]);
    return *lines[0] != '\0';
}

void guard_prepare(const char *program) {
    int *utf8_mode;
    void (*set_name)(const wchar_t *);
    wchar_t *(*decode)(const char *, size_t *);
    /* a bare environment means ASCII, and a folder with an umlaut would not be found */
    if (guard_symbol(NULL, "Py_UTF8Mode", &utf8_mode)) *utf8_mode = 1;
    int known = guard_symbol(NULL, "Py_SetProgramName", &set_name) &&
                guard_symbol(NULL, "Py_DecodeLocale", &decode);
    wchar_t *wide = known && *program ? decode(program, NULL) : NULL;
    if (wide) set_name(wide); /* Python keeps the pointer for good */
}

/* In the child. A failure ends it with words on stderr, which is the pipe. */
static void try_here(int end) {
    void (*start)(int);
    dup2(end, 2);
    if (guard_symbol(NULL, "Py_InitializeEx", &start)) start(0);
    if (write(end, "\nstarts", 7) != 7) _exit(1);
    _exit(0);
}

int guard_try_python(char *why) {
    int ends[2];
    char said[TEXT];
    if (pipe2(ends, O_CLOEXEC)) return 1; /* no way to try is no reason to refuse */
    pid_t child = fork();
    if (child == 0) try_here(ends[1]);
    close(ends[1]);
    if (child < 0) {
        close(ends[0]);
        return 1;
    }
    listen_to(child, ends[0], said);
    if (strstr(said, "\nstarts")) return 1;
    char *fatal = strstr(said, "Fatal"), *line_end = strchr(fatal ? fatal : said, '\n');
    if (line_end) *line_end = '\0';
    snprintf(why, TEXT, "the Python of %.1000s cannot start (%.500s); is PYTHONHOME another's?",
             guard_library(), fatal ? fatal : said);
    return 0;
}
