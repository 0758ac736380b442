/* caution.h: protects the robot where its proximity sensors do not: it backs off from what it touches, and looks
 * aside as it drives while it distrusts its front sensor. What it finds counts as ahead until it has turned away. */
#ifndef OCTET_CAUTION_H
#define OCTET_CAUTION_H

#include "firmware/brain.h"

struct caution {
    uint8_t doing;       /* an enum doing of caution.c */
    uint8_t beside;      /* the sensor on the side of the current turn, as it was when that began; a bit of feel */
    uint8_t blind_mm;    /* distance since it last looked aside, mm; saturates at ASIDE_EVERY_MM */
    bool ahead;          /* an obstacle is ahead that no sensor shows, */
    int8_t turned_deg;   /* and the robot has turned this far since, right positive */
    bool pressed;        /* the bumper is still pressed after backing off: the obstacle is not ahead */
};   /* all 0: it has touched nothing */

bool caution_stops(struct caution *caution, const struct senses *senses, bool forward);
        /* Whether a step forward hits an obstacle and must end. Call once for each senses. */

struct action caution_next(struct caution *caution, struct brain *brain, const struct config *config,
                           struct senses *senses);
        /* Calls brain_next unless caution chooses the action. senses->feel holds the believed sensors; the front one
           is added if an obstacle is ahead. */

void caution_see(struct caution *caution, uint8_t feel, bool blind);
        /* An action has ended. feel: the sensors believed. blind: the front sensor is triggered but not believed. */

#endif
