/* robot_rig.h: a robot, started with the article's behaviour before each test, and its output. */
#ifndef OCTET_ROBOT_RIG_H
#define OCTET_ROBOT_RIG_H

#include "firmware/robot.h"

enum { CLEAR = 0, FRONT = 4, PATTERN_FRONT = 2, TICKS_PER_SECOND = 50, MANY = 1000 };

extern struct robot robot;
extern struct output out;       /* of the last response */
extern struct senses wheels;    /* of a body that obeys */

void respond_to(enum input_kind kind, const struct input *in);
void sense(struct senses senses);
void feel(uint8_t feel);
        /* Responds to senses with only these sensors triggered. */

void silence(void);
void command(enum opcode opcode, uint8_t which, uint32_t value);
        /* The robot responds to one input. */

void obey(uint8_t feel);
        /* Responds to the next tick: the wheels have followed the last drive, and these sensors are triggered. */

void teach(enum side side);
        /* Puts the side into the cell of an obstacle in front. */

void assert_at_rest(void);
        /* Checks that the last output stops the wheels. */

#endif
