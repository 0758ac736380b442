/* hal.h: all that the robot asks of its body. Exactly one implementation is linked in.
 *
 * Results: 0 or a positive number is fine, a negative one is an enum hal_error. One thread calls all of these, never an
 * interrupt handler. */
#ifndef OCTET_HAL_H
#define OCTET_HAL_H

#include "firmware/io.h"

enum { HAL_SILENCE_MS = 100 };   /* without senses for this long, the wheels stop */

enum hal_error {
    HAL_E_BODY = -1,     /* the body cannot be reached; said on the console where there is one */
    HAL_E_USAGE = -2,    /* the arguments make no sense; said on the console where there is one */
    HAL_E_CLOSED = -3,   /* the body is gone for good */
    HAL_E_STORE = -4     /* the memory could not be stored, or what is stored is not a memory */
};

struct hal;   /* one body */

int hal_open(struct hal **hal, int argc, char *const argv[]);
        /* Gets the body ready, wheels at rest. 0, or HAL_E_USAGE or HAL_E_BODY with *hal untouched.
           argc is 0 where there is no command line. */

int hal_receive(struct hal *hal, struct input *in);
        /* Waits for the next input, in the order in which they came, and fills that part of *in. At most HAL_SILENCE_MS.
           INPUT_SENSES, INPUT_COMMAND: senses, or a command.
           INPUT_PEER: half of the memory of another robot. Of each half of each robot the first one between two reports, and
           only where each pattern has a cell. A body that hears no other robots never returns this.
           INPUT_SILENCE: no senses for HAL_SILENCE_MS, and again for each such time. Frames that are stale, damaged or not ours
           are counted and skipped, and do not break the silence.
           HAL_E_CLOSED: the body is gone for good, and the robot ends. */

int hal_send(struct hal *hal, const struct output *out);
        /* Sends the marked parts, the drive last. 0, also where the bus took too long and a frame was dropped and
           counted: the next tick brings a newer one. HAL_E_CLOSED as above. */

int hal_load(struct hal *hal, uint8_t memory[CELL_COUNT]);
        /* The memory as last stored. 1: filled. 0: none was ever stored. HAL_E_STORE: what is there is no memory;
           it is left as it is. memory is written to only with result 1. */

int hal_store(struct hal *hal, const uint8_t memory[CELL_COUNT], bool at_rest);
        /* All or nothing: after a loss of power inside, hal_load gives the old memory or the new one. 0, or HAL_E_STORE,
           counted: it gives the old one, or after a reset perhaps the new one. at_rest: the wheels stand, and it may take
           a second. If not, a body that would need long puts it off until the next silence: 0, and until then hal_load gives
           the old one. */

uint32_t hal_entropy(struct hal *hal);
        /* A number that differs from one power-up to the next as well as this body can. Never fails. */

#endif
