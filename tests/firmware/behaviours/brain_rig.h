/* brain_rig.h: a brain, and what the tests of its behaviours share. */
#ifndef OCTET_BRAIN_RIG_H
#define OCTET_BRAIN_RIG_H

#include "tests/test.h"
#include "firmware/brain.h"

enum { CLEAR = 0, FRONT_RIGHT = FEEL_FRONT_RIGHT, FRONT = FEEL_FRONT, FRONT_LEFT = FEEL_FRONT_LEFT, ALL_THREE = 14 };
enum { PATTERN_FRONT_RIGHT = 1, PATTERN_FRONT = 2, PATTERN_FRONT_LEFT = 4, PATTERN_ALL_THREE = 7 };

extern struct brain brain;
extern struct config config;

void begin(enum profile profile);
        /* Starts this profile with an empty memory and the default parameters. */

struct action next(uint8_t feel);
        /* The next action, where the last one ended with these sensors triggered. */

struct action next_seeing_food(uint8_t feel, uint16_t beacon_mm);
        /* The same, with food in sight. */

void teach(uint8_t pattern, enum side side);
        /* Puts the side into the pattern's cell. */

void assert_action(enum reason reason, int turn_deg, unsigned forward_mm, struct action action);
        /* Checks reason, turn and distance of an action. */

void remembered_turns(unsigned count);
        /* Checks that the next so many actions, blocked in front, are remembered turns. */

#endif
