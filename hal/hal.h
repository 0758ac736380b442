/* hal.h: all that the robot asks of its body. Exactly one implementation is linked in.
 *
 * Results: 0 or a positive number is fine, a negative one is an enum hal_error. One thread calls all of these, never
 * an interrupt handler. */
#ifndef OCTET_HAL_H
#define OCTET_HAL_H

#include "firmware/io.h"

enum { HAL_SILENCE_MS = 100 };   /* without senses for this long, the wheels stop */

enum hal_error {
    HAL_E_BODY = -1,     /* the body cannot be reached; reported on the console where there is one */
    HAL_E_USAGE = -2,    /* invalid arguments; reported on the console where there is one */
    HAL_E_CLOSED = -3,   /* the body is gone for good */
    HAL_E_STORE = -4     /* the memory could not be stored, or what is stored is not a memory */
};

struct hal;   /* one body */

int hal_open(struct hal **hal, int argc, char *const argv[]);
        /* Prepares the body, with the wheels at rest. Returns 0, or HAL_E_USAGE or HAL_E_BODY with *hal untouched.
           argc is 0 where there is no command line. */

int hal_receive(struct hal *hal, struct input *in);
        /* Waits up to HAL_SILENCE_MS for the next input, in order of arrival, and fills the matching member of *in.
           INPUT_SENSES, INPUT_COMMAND: senses, or a command.
           INPUT_PEER: half of another robot's memory. At most one per half, robot and report period, and only if the
           behaviour has a cell per pattern. A body that hears no other robots never returns this.
           INPUT_SILENCE: no senses for HAL_SILENCE_MS; returned once per such period. Frames that are stale, damaged
           or not ours are counted and skipped, and do not end the silence.
           HAL_E_CLOSED: the body is gone for good; the robot must end. */

int hal_send(struct hal *hal, const struct output *out);
        /* Sends the parts that are marked, the drive last. Returns 0 even if the bus took too long and a frame was
           dropped and counted: the next tick brings a newer one. HAL_E_CLOSED as above. */

int hal_load(struct hal *hal, uint8_t memory[CELL_COUNT]);
        /* Loads the memory that was stored last. 1: loaded. 0: none was ever stored. HAL_E_STORE: what is stored is
           not a memory; it is left as it is. Writes to memory only if the result is 1. */

int hal_store(struct hal *hal, const uint8_t memory[CELL_COUNT], bool at_rest);
        /* Stores the memory, all or nothing: after a power loss during the call, hal_load returns the old memory or
           the new one. Returns 0, or HAL_E_STORE, counted: hal_load returns the old one, or possibly the new one
           after a reset. at_rest: the wheels stand still, and the call may take a second. Otherwise a body that would
           take long returns 0 and stores at the next silence; until then, hal_load returns the old one. */

uint32_t hal_entropy(struct hal *hal);
        /* A number that differs between power-ups, as well as this body can provide it. Never fails. */

#endif
