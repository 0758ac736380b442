/* deadline.h: waiting that ends at one moment, however often signals interrupt it. */
#ifndef OCTET_DEADLINE_H
#define OCTET_DEADLINE_H

#include <stdbool.h>
#include <stdint.h>

int64_t deadline_in_ms(uint32_t ms);
        /* That far from now, in ns of the clock that never jumps. */

uint32_t deadline_left_ms(int64_t deadline);
        /* From now until then, rounded up; 0: it has passed. */

bool deadline_await_input(int fd, int64_t deadline);
        /* Waits until there is something to read from fd, or an error: true. False: the deadline came first. */

bool deadline_pause(int64_t deadline);
        /* Rests for a millisecond, or less where a signal ends it. False, and no rest: the deadline has passed. */

#endif
