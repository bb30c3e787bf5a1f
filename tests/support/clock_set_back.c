// SPDX-License-Identifier: GPL-3.0-or-later
// To be preloaded: the time of day goes back by an hour whenever it is asked for.
#define _GNU_SOURCE
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

static time_t hours_back(void)
{
    static time_t hours = 0;
    return 3600 * ++hours;
}

int clock_gettime(clockid_t clock, struct timespec* now)
{
    const int failure = (int)syscall(SYS_clock_gettime, clock, now);
    if (failure == 0 && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE)) now->tv_sec -= hours_back();
    return failure;
}

int gettimeofday(struct timeval* now, void* zone)
{
    const int failure = (int)syscall(SYS_gettimeofday, now, zone);
    if (failure == 0) now->tv_sec -= hours_back();
    return failure;
}

time_t time(time_t* to)
{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    if (to) *to = now.tv_sec;
    return now.tv_sec;
}
