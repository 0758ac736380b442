/* The parameters: whatever is commanded, each keeps to its range. */
#include <stdlib.h>

#include "firmware/robot.h"
#include "tests/proof/any/any.h"

static void leave_a_range(void)
{
    //@ assert never_called: \false;
    abort();
}

static void check(const struct config *config)
{
#define CHECK(parameter, minimum, maximum, initial) \
    if (config->value[parameter] < minimum || config->value[parameter] > maximum) \
        leave_a_range();
    ROBOT_PARAMETERS(CHECK)
}

void exercise(void)
{
    struct robot robot;
    struct command set = {.opcode = OPCODE_SET};
    uint32_t value;

    robot_init(&robot, any_u32());
    while (any_more()) {
        //@ loop unroll 255;
        for (set.which = 0; set.which < UINT8_MAX; set.which++) {
            set.value = any_u32();
            (void)robot_execute(&robot, &set, &value);
        }
        check(&robot.config);
    }
}
