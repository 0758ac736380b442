/* brain_rig.h: a brain that decides, and what the tests of its behaviours ask of it. */
#ifndef OCTET_BRAIN_RIG_H
#define OCTET_BRAIN_RIG_H

#include "tests/test.h"
#include "firmware/brain.h"

enum { CLEAR = 0, FRONT_RIGHT = FEEL_FRONT_RIGHT, FRONT = FEEL_FRONT, FRONT_LEFT = FEEL_FRONT_LEFT, ALL_THREE = 14 };
enum { PATTERN_FRONT_RIGHT = 1, PATTERN_FRONT = 2, PATTERN_FRONT_LEFT = 4, PATTERN_ALL_THREE = 7 };

extern struct brain brain;
extern struct config config;

void begin(enum profile profile);
        /* Empty, with the default parameters. */

struct action next(uint8_t feel);
        /* The last action has ended with these sensors triggered. */

struct action next_seeing_food(uint8_t feel, uint16_t beacon_mm);
        /* The same, with food in sight. */

void learned(uint8_t pattern, enum side side);
        /* It remembers that side from now on. */

void assert_action(enum reason reason, int turn_deg, unsigned forward_mm, struct action action);
        /* It is this action. */

void remembered_turns(unsigned count);
        /* Blocked in front, it makes so many remembered turns. */

#endif
