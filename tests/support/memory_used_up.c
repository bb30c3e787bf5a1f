// SPDX-License-Identifier: GPL-3.0-or-later
// To be preloaded: once the file that MEMORY_ENDS_WITH names is there, nothing of a page or more can be had.
#include <errno.h>
#include <stdlib.h>
#include <unistd.h>

void* __libc_malloc(size_t size);

void* malloc(size_t size)
{
    if (size >= 4096) {
        const char* file = getenv("MEMORY_ENDS_WITH");
        const int errno_before = errno;
        if (file && access(file, F_OK) == 0) {
            errno = ENOMEM;
            return NULL;
        }
        errno = errno_before;
    }
    return __libc_malloc(size);
}
