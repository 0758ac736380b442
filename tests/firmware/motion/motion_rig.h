/* motion_rig.h: motion, and two wheels with odometers. */
#ifndef OCTET_MOTION_RIG_H
#define OCTET_MOTION_RIG_H

#include "firmware/motion/motion.h"

extern const double PI;

/* Two wheels that follow their commands exactly, but for grip and left_share, with odometers. */
struct ideal_wheels {
    double left_mm, right_mm;
    double grip;   /* speed of both wheels as a part of the commanded one; above 1 if they are faster, or count too much */
    double left_share;   /* speed of the left wheel as a part of that */
    uint8_t feel;
    uint8_t tick;
};

extern struct ideal_wheels body;
extern struct config config;
extern struct motion motion;
extern struct random dice;

enum {
    HALF = 500, ROUNDING = 1,                    /* of a degree or a millimetre, in thousandths */
    STEP_MAX_MM = 250, TURN_MAX_DEG = 360 + 179  /* no step or turn of any behaviour is greater */
};

uint16_t counted(double mm);
        /* What an odometer shows after that distance. */

struct senses sensed(void);
        /* The body's current senses. */

long heading_mdeg(void);
        /* The angle by which the wheels have turned the body, right positive, in 1/1000 degree. */

struct drive commanded(void);
        /* The current command to the wheels. */

bool tick(void);
        /* The wheels follow their command for a tick, and motion tracks it. True: the action has ended. */

void roll(int left_counts, int right_counts);
        /* A tick in which the odometers count that far, whatever was commanded. */

void begin(int turn_deg, unsigned forward_mm);
        /* Begins a turn, a step of up to STEP_MAX_MM, or with 0 and 0 a rest. */

unsigned act(int turn_deg, unsigned forward_mm);
        /* Begins such an action and ends it. Returns how many ticks it took. */

void stand_at(double left_mm, double right_mm);
        /* A new motion, of sound wheels that have rolled that far. */

void set_corner(unsigned corner);
        /* The four parameters that motion depends on, each at an end of its range: corner 0..15. */

#endif
