/* encoder.h: counts the two wheels' encoders by PIO0, whatever the core does meanwhile. */
#ifndef OCTET_RP2040_ENCODER_H
#define OCTET_RP2040_ENCODER_H

#include <stdint.h>

void encoder_start(unsigned side, uint32_t pin);
        /* Counts up from about 0 while the channel at pin leads the one at the next pin. */

uint16_t encoder_count(unsigned side);
        /* The count as it is now; wraps. The last one, if the state machine does not answer. */

#endif
