/* robot_rig.h: a robot that each test starts anew as the article's, and what it answers to what a test lets it sense. */
#ifndef OCTET_ROBOT_RIG_H
#define OCTET_ROBOT_RIG_H

#include "firmware/robot.h"

enum { CLEAR = 0, FRONT = 4, PATTERN_FRONT = 2, TICKS_PER_SECOND = 50, MANY = 1000 };

extern struct robot robot;
extern struct output out;       /* the robot's last answer */
extern struct senses wheels;    /* of a body that obeys */

void respond_to(enum input_kind kind, const struct input *in);
void sense(struct senses senses);
void feel(uint8_t feel);
        /* Senses with nothing but these sensors triggered. */

void silence(void);
void command(enum opcode opcode, uint8_t which, uint32_t value);
        /* The robot answers to one input. */

void obey(uint8_t feel_there);
        /* A tick later: the wheels have done what they were last told, and these sensors are triggered. */

void learned(enum side side);
        /* The robot remembers that side for an obstacle in front from now on. */

void assert_at_rest(void);
        /* The last answer stops the wheels. */

#endif
