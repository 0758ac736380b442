/* guard.h: stands between the robot and its user's behaviour, on the host. guard.c finds failures; checked.c handles
 * them in a process of the robot's own, and fast.c in the simulator's process. */
#ifndef OCTET_GUARD_H
#define OCTET_GUARD_H

#include <stdbool.h>
#include <stddef.h>

enum { GUARD_TEXT_MAX = 600 };

const char *own_failure(const void *robot);
        /* The failure of this robot, or of any if it is null: the tick as a number, a space, and a message in one
           line. Empty if there was none. */

long guard_when(char *text, size_t size);
        /* The tick of the decision under way, -1 at the start of a run; with its senses, in words, too. */

void guard_fail(const void *code, const char *place, const char *what);
        /* The decision under way is wrong: at a place in the source or, if that is null, where this code is. Does not
           return while a decision is under way. */

void guard_place(const void *code, char *text, size_t size);
        /* In checked.c and fast.c: the file and line of code, empty if they are not known. */

void guard_end(const char *text);
        /* In both, too: handles a failure. Returns if the robot is to stand still from now on. */

void guard_watch(bool on);
        /* In both, too: a decision begins or ends. */

#endif
