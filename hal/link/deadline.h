/* deadline.h: waits with a deadline that signals do not extend. */
#ifndef OCTET_DEADLINE_H
#define OCTET_DEADLINE_H

#include <stdbool.h>
#include <stdint.h>

int64_t deadline_in_ms(uint32_t ms);
        /* The deadline that far from now, ns of the monotonic clock. */

uint32_t deadline_left_ms(int64_t deadline);
        /* Time left, rounded up; 0: the deadline has passed. */

bool deadline_await_input(int fd, int64_t deadline);
        /* Waits until fd is readable or has an error: true. False: the deadline came first. */

bool deadline_pause(int64_t deadline);
        /* Sleeps for a millisecond, or less if a signal comes. False, without sleeping: the deadline has passed. */

#endif
