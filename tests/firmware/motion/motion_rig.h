/* motion_rig.h: motion, and two wheels that count their way. */
#ifndef OCTET_MOTION_RIG_H
#define OCTET_MOTION_RIG_H

#include "firmware/motion/motion.h"

extern const double PI;

/* Two wheels that do exactly as they are told, and count their way. */
struct wheels_of_a_body {
    double left_mm, right_mm;
    double grip;   /* wheels make this part of the wanted speed; more than 1 if they are faster, or count too much */
    double lame;   /* the left wheel makes this part of that */
    uint8_t feel;
    uint8_t tick;
};

extern struct wheels_of_a_body body;
extern struct config config;
extern struct motion motion;
extern struct random dice;

enum {
    HALF = 500, HARDLY_ANY = 1,                  /* of a degree or a millimetre, in thousandths */
    STEP_MAX_MM = 250, TURN_MAX_DEG = 360 + 179  /* no step or turn of any behaviour is greater */
};

uint16_t counted(double mm);
        /* What an odometer shows after that way. */

struct senses sensed(void);
        /* What the body senses as it is. */

long heading_mdeg(void);
        /* How far the wheels have turned the body, right positive, in 1/1000 degree. */

struct drive driven(void);
        /* What the wheels are told now. */

bool tick(void);
        /* The wheels turn for one tick, and what they did is sensed. True: the action has ended. */

void roll(int left_counts, int right_counts);
        /* A tick in which the odometers count that far, whatever the wheels are told. */

void begin(int turn_deg, unsigned forward_mm);
        /* A turn, a step of up to STEP_MAX_MM, or with 0 and 0 a rest. */

unsigned act(int turn_deg, unsigned forward_mm);
        /* Carries such an action through. Returns how many ticks it took. */

void stand_at(double left_mm, double right_mm);
        /* A new motion, of sound wheels that have rolled that far. */

void set_corner(unsigned corner);
        /* The four parameters that motion depends on, each at an end of its range: corner 0..15. */

#endif
