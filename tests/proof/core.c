/* The core: whatever is sensed, commanded or stored, in whatever order and however long. Parameters may change at any
 * time; that they keep to their ranges is proved in config.c. */
#include "tests/proof/any/robot.h"

static void wake_with_any_memory(void)
{
    uint8_t cells[CELL_COUNT];

    for (unsigned p = 0; p < CELL_COUNT; p++)
        cells[p] = any_u8();
    robot_init(&robot, any_u32());
    (void)brain_adopt(&robot.brain, cells);
}

void exercise(void)
{
    wake_with_any_memory();
    /* The limits that motion clamps to, so that the analyser stops there. */
    //@ loop widen_hints "all", -1000000000, 1000000000;
    while (any_more()) {
        take_any_parameters();
        take_any_input();
        respond((enum input_kind)any_between(INPUT_SILENCE, INPUT_PEER));
        //@ assert fits_the_wire: !out.has_drive || (-2047 <= out.drive.left_mm_s <= 2047 && -2047 <= out.drive.right_mm_s <= 2047);
    }
}
