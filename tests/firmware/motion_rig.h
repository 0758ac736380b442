/* motion_rig.h: motion, and two wheels that count their way. */
#ifndef OCTET_MOTION_RIG_H
#define OCTET_MOTION_RIG_H

#include "firmware/motion.h"

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

uint16_t counted(double mm);

struct senses sensed(void);

/* Half a degree and half a millimetre, in thousandths as below. */
enum { HALF = 500, HARDLY_ANY = 1 };

long heading_mdeg(void);

struct drive driven(void);

bool tick(void);

void begin(int turn_deg, unsigned forward_mm);

unsigned act(int turn_deg, unsigned forward_mm);

void stand_at(double left_mm, double right_mm);

void set_corner(unsigned corner);

#endif
