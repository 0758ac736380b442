/* encoder.h: counts the two wheels' encoders by PIO0, whatever the core does meanwhile. */
#ifndef OCTET_RP2040_ENCODER_H
#define OCTET_RP2040_ENCODER_H

#include <stdint.h>

enum { ENCODERS = 2 };

void encoders_start(const uint8_t pins[ENCODERS]);
        /* Each counts up from about 0 while the channel at its pin leads the one at the next pin. */

uint16_t encoder_count(unsigned side);
        /* The count as it is now; wraps. The last one, if the state machine does not answer. */

#endif
