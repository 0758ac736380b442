/* perception.h: filters the proximity sensors, as the parameters FILTER and DISTRUST say. Both are off by default:
 * then every reading is believed. */
#ifndef OCTET_PERCEPTION_H
#define OCTET_PERCEPTION_H

#include "firmware/config.h"

struct perception {
    uint8_t before[2];              /* the readings of the two ticks before, newest first */
    uint8_t in_a_row[FEEL_COUNT];   /* decisions in which the sensor was triggered; stays at 255 */
};

void perception_start(struct perception *perception);
        /* Resets: no earlier readings, and every sensor is trusted. */

uint8_t perception_filter(struct perception *perception, const struct config *config, uint8_t feel);
        /* The reading of this tick; with FILTER, the bitwise majority of the last three ticks. Call once for each
           senses. */

void perception_decide(struct perception *perception, const struct config *config, uint8_t feel);
        /* A decision is made with these sensors triggered. A sensor that is triggered in DISTRUST decisions in a row
           is not believed until it has been quiet in one. */

uint8_t perception_believed(const struct perception *perception, const struct config *config, uint8_t feel);
        /* Those of these sensors that are believed. */

#endif
