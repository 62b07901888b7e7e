/* Where the library lies that this code is in. Not part of C sources, which read no part.bin. */
#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#else
#ifdef __linux__
#define _GNU_SOURCE /* dladdr */
#endif
#include <dlfcn.h>
#ifdef __linux__
#pragma weak dladdr /* of libdl before glibc 2.34, which a host that loads libraries has */
#endif
#endif
#include <string.h>

#include "library_file.h"

#define LONGEST 4096

void find_library(char *path, size_t room) {
    static const char here = 0;
    path[0] = '\0';
#ifdef _WIN32
    wchar_t wide[LONGEST];
    HMODULE own = NULL;
    const DWORD how = GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT;
    if (!GetModuleHandleExW(how, (LPCWSTR)(const void *)&here, &own)) return;
    const DWORD n = GetModuleFileNameW(own, wide, LONGEST);
    if (n == 0 || n == LONGEST) return;
    if (!WideCharToMultiByte(CP_UTF8, 0, wide, -1, path, (int)room, NULL, NULL)) path[0] = '\0';
#else
    Dl_info info = {0};
    if (!dladdr || !dladdr(&here, &info) || !info.dli_fname) return;
    const size_t n = strlen(info.dli_fname) + 1;
    if (n <= room) memcpy(path, info.dli_fname, n);
#endif
}
