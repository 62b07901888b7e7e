/* Where the library lies that this code is in. */
#ifndef THRUSTWASHER_LIBRARY_FILE_H
#define THRUSTWASHER_LIBRARY_FILE_H

#include <stddef.h>

void find_library(char *path, size_t room); /* in UTF-8; empty: not to be had */

#endif
