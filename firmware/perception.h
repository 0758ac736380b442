/* perception.h: what the robot believes of what its proximity sensors say: with FILTER and DISTRUST, parameters that are
 * off by default, not all of it. */
#ifndef OCTET_PERCEPTION_H
#define OCTET_PERCEPTION_H

#include "firmware/config.h"

struct perception {
    uint8_t before[2];              /* what was sensed in the two ticks before, the last one first */
    uint8_t in_a_row[FEEL_COUNT];   /* decisions in which the sensor was triggered; stays at 255 */
};

void perception_start(struct perception *perception);
        /* Nothing was sensed before, and every sensor is trusted. */

uint8_t perception_filter(struct perception *perception, const struct config *config, uint8_t feel);
        /* What was sensed in this tick: with FILTER, bit by bit, what two of the last three ticks have said. Call once
           for each senses. */

void perception_decide(struct perception *perception, const struct config *config, uint8_t feel);
        /* A decision is made with these sensors triggered. A sensor that is triggered in DISTRUST decisions in a row is not
           believed until it has been quiet in one. */

uint8_t perception_believed(const struct perception *perception, const struct config *config, uint8_t feel);
        /* Those of these sensors that are believed. */

#endif
