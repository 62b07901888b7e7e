/* Calls one of the functions that a library shows to Python, on whatever platform:
   table LIBRARY PLACE RETURNED NUMBER...: prints the numbers that come back, in hexadecimal. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#ifdef _WIN32
#include <windows.h>
#define OPEN(path) ((void *)LoadLibraryA(path))
#define FIND(library, name) ((void *)GetProcAddress((HMODULE)(library), name))
#else
#include <dlfcn.h>
#define OPEN(path) dlopen(path, RTLD_NOW)
#define FIND(library, name) dlsym(library, name)
#endif

typedef int32_t (*Function)(int32_t *, void **, double *, double *);

int main(int n, char **words)
{
    void *library = n > 3 ? OPEN(words[1]) : NULL;
    const Function *(*table)(void) = NULL;
    if (library) *(void **)&table = FIND(library, "tw_table");
    const Function *functions = table ? table() : NULL;
    if (!functions) return 1;

    double block[64];
    int32_t result = -1;
    void *raised = NULL;
    const int given = n - 4;
    for (int i = 0; i < given; i++) block[i] = strtod(words[4 + i], NULL);
    if (functions[atoi(words[2])](&result, &raised, block, block)) return 2;
    for (int i = 0; i < atoi(words[3]); i++) printf("%a\n", block[given + i]);
    return 0;
}
