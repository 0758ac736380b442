#include "tests/proof/any/command.h"

#include <octet.h>

#include "hal/protocol/e2e.h"
#include "tests/proof/any/any.h"

enum { COUNTER_PLACE = 1, OPCODE_BITS = 0xF0, OWNER_PLACE = 2 };

struct frame any_command(uint8_t owner, unsigned before)
{
    struct frame frame = {.id = OCTET_COMMAND_FRAME_ID, .len = OCTET_COMMAND_LENGTH};

    for (unsigned i = 1; i < frame.len; i++)
        frame.data[i] = any_u8();
    frame.data[COUNTER_PLACE] = (uint8_t)((frame.data[COUNTER_PLACE] & OPCODE_BITS) | before % E2E_COUNTERS);
    frame.data[OWNER_PLACE] = owner;
    e2e_protect(&frame);
    return frame;
}
