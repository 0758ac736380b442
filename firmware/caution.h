/* caution.h: what the robot does where its proximity sensors do not protect it: it backs off from what it touches, and looks
 * aside on its way where it does not believe its front sensor. What it finds so is ahead for the brain, until it has turned away. */
#ifndef OCTET_CAUTION_H
#define OCTET_CAUTION_H

#include "firmware/brain.h"

struct caution {
    uint8_t doing;       /* an enum doing of caution.c */
    uint8_t beside;      /* what the sensor to which the turn under way goes showed when it began, as a bit of feel */
    uint8_t blind_mm;    /* driven since it last looked aside; ASIDE_EVERY_MM if that is far enough */
    bool ahead;          /* something is ahead that no sensor shows, */
    int8_t turned_deg;   /* and the robot has turned by so much since, right positive */
    bool pressed;        /* the bumper has not let go since the robot backed off: what it touches is not ahead */
};   /* all 0: it has touched nothing */

bool caution_stops(struct caution *caution, const struct senses *senses, bool forward);
        /* Whether a step forward runs into something, and must end. Call once for each senses. */

struct action caution_next(struct caution *caution, struct brain *brain, const struct config *config,
                           struct senses *senses);
        /* As brain_next, which is asked unless something else comes first. senses->feel is as it is believed, and gains the front
           sensor where something is ahead. */

void caution_see(struct caution *caution, uint8_t feel, bool blind);
        /* An action has ended, and these sensors are believed. blind: the front one is triggered, and is not. */

#endif
