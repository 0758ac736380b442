#include "hal/pins_body/inputs.h"

/* ---- the button */

enum { SURE = 3, START_TICKS = 50, FORGET_TICKS = 250 };

static bool told(struct command *command, enum opcode opcode, uint8_t which)
{
    *command = (struct command){.opcode = opcode, .which = which};
    return true;
}

/* Debounces the contact. Returns true if the button is now pressed or released. */
static bool changes(struct button *button, bool pressed)
{
    button->same = pressed == button->down ? 0 : (uint8_t)(button->same + 1);
    if (button->same < SURE) {
        button->ticks = (uint16_t)(button->ticks + (button->ticks < FORGET_TICKS ? 1 : 0));
        return false;
    }
    button->same = 0;
    button->down = pressed;
    button->ticks = 0;
    return true;
}

static bool let_go(struct button *button, bool running, struct command *command)
{
    if (button->held || running) {
        button->presses = 0;
        return button->held ? false : told(command, OPCODE_STOP, 0);
    }
    button->presses = (uint8_t)(button->presses % PROFILE_COUNT + 1);
    return false;
}

bool button_look(struct button *button, bool pressed, bool running, struct command *command)
{
    if (changes(button, pressed)) {
        if (!button->down)
            return let_go(button, running, command);
        button->held = false;
    }
    if (button->down && !button->held && button->ticks == FORGET_TICKS) {
        button->held = true;
        return told(command, OPCODE_ERASE, 0);
    }
    if (!button->down && button->presses > 0 && button->ticks >= START_TICKS) {
        uint8_t profile = (uint8_t)(button->presses - 1);

        button->presses = 0;
        return told(command, OPCODE_START, profile);
    }
    return false;
}

/* ---- the proximity sensors */

enum { WALL_MM = 60, BEHIND_MM = 20 };

uint8_t proximity_feel(struct proximity *proximity, const uint16_t dark[FEEL_COUNT])
{
    unsigned triggered = 0;

    for (unsigned i = 0; i < FEEL_COUNT; i++) {
        unsigned back = proximity->lit[i] > dark[i] ? (unsigned)proximity->lit[i] - dark[i] : 0;
        unsigned near = proximity->near[i];

        proximity->back[i] = (uint16_t)back;
        if ((proximity->feel >> i & 1) != 0)
            near -= near / PROXIMITY_HYSTERESIS_PART;
        triggered |= (back >= near ? 1u : 0u) << i;
    }
    proximity->feel = (uint8_t)triggered;
    return proximity->feel;
}

/* Light decreases with the square of the distance from a point behind the sensor's window. */
uint8_t proximity_range_mm(const struct proximity *proximity, unsigned sensor)
{
    uint32_t square, range_mm = 0;

    if ((proximity->feel >> sensor & 1) == 0)
        return RANGE_NONE;
    square = (uint32_t)proximity->near[sensor] * (WALL_MM + BEHIND_MM) * (WALL_MM + BEHIND_MM)
           / proximity->back[sensor];
    while ((range_mm + 1 + BEHIND_MM) * (range_mm + 1 + BEHIND_MM) <= square)
        range_mm++;
    return (uint8_t)range_mm;
}
