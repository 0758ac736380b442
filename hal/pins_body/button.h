/* button.h: one button for a robot without a PC. Pressed while the robot runs, it stops. Pressed n times at rest, it starts with
 * the n-th profile, a second after the last press. Held for five seconds, it forgets. */
#ifndef OCTET_BUTTON_H
#define OCTET_BUTTON_H

#include "firmware/io.h"

struct button {
    uint8_t same;       /* looks in a row that differ from what is taken to be the case */
    bool down;          /* what is */
    uint8_t presses;    /* since the robot rests */
    uint16_t ticks;     /* since it went down, or was let go; stays at the end */
    bool held;          /* as long as it forgets */
};   /* all 0: not pressed */

bool button_look(struct button *button, bool pressed, bool running, struct command *command);
        /* Once a tick of 20 ms. True: it has been told something, and *command is that; the seed of a start is left to the caller. */

#endif
