/* button.h: one button for a robot without a PC. Pressed while the robot runs, it stops. Pressed n times at rest, it
 * starts with the n-th profile, a second after the last press. Held for five seconds, it erases its memory. */
#ifndef OCTET_BUTTON_H
#define OCTET_BUTTON_H

#include "firmware/io.h"

struct button {
    uint8_t same;       /* debouncing: readings in a row that differ from down */
    bool down;          /* debounced state */
    uint8_t presses;    /* since the robot came to rest */
    uint16_t ticks;     /* since it was pressed or released; saturates */
    bool held;          /* long enough to erase the memory */
};   /* all 0: not pressed */

bool button_look(struct button *button, bool pressed, bool running, struct command *command);
        /* Call once per tick of 20 ms. True: *command holds a command; the caller sets the seed of a start. */

#endif
