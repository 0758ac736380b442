/* robot_rig.h: a robot, and what it answers to what a test lets it sense. */
#ifndef OCTET_ROBOT_RIG_H
#define OCTET_ROBOT_RIG_H

#include "firmware/robot.h"

enum { CLEAR = 0, FRONT = 4, PATTERN_FRONT = 2, TICKS_PER_SECOND = 50, MANY = 1000 };

extern struct robot robot;

extern struct output out;

extern struct senses wheels;

void respond_to(enum input_kind kind, const struct input *in);

void sense(struct senses senses);

void feel(uint8_t feel);

void silence(void);

void command(enum opcode opcode, uint8_t which, uint32_t value);

void learned(enum side side);

void assert_at_rest(void);

void obey(uint8_t feel_there);

#endif
