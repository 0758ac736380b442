/* can_rig.h: what the contract of the link over a CAN controller needs of a controller's model. One rig is linked in for each. */
#ifndef OCTET_CAN_RIG_H
#define OCTET_CAN_RIG_H

#include <stdbool.h>

#include "hal/link/link.h"

extern const uint32_t RIG_CLOCKS_HZ[];   /* that chips with this controller may run it at; ends with 0 */

struct rig_bit {
    uint32_t prescaler, before, after, jump;   /* in quanta, the sample point between before and after */
};

void rig_reset(void);
        /* A chip that has just been reset, as its boot loader may leave it, on a quiet bus. Its time goes on whenever the driver
           looks at the clock. */

void rig_set_clock(uint32_t hz);
uint32_t rig_ms(void);
void rig_pass_us(uint32_t us);

struct rig_bit rig_bit(void);
        /* As the driver has set it up. */

void rig_deliver(const struct frame *frame);
        /* Arrives over the bus. */

int rig_fifo_for(uint32_t id);
        /* In which of its FIFOs a data frame with this standard identifier would reach the driver, or -1. */

void rig_open_filters(void);
        /* From here on every frame does. */

unsigned rig_sent_count(void);
const struct frame *rig_sent(unsigned n);
        /* What has arrived at the other nodes so far. */

void rig_block(bool blocked);
        /* The bus is never idle: nothing can be sent, and it cannot be joined. */

void rig_occupy(uint32_t id);
        /* From here on other nodes send frames of this identifier without a pause, for at least 200 ms. 0: they stop. */

void rig_stall(void);
        /* From here on the controller neither sends what it has nor gives it up. */

void rig_enter_bus_off(void);
bool rig_is_bus_off(void);
void rig_keep_bus_off(void);
        /* The idle times that end bus-off never come. */

void rig_stop_answering(void);
        /* The controller does not answer when it is to leave the bus. */

unsigned rig_departures(void);
        /* How often the controller has left the bus so far. */

bool rig_is_off_bus(void);
        /* Neither on the bus nor about to join it. */

void rig_set_errors(uint8_t tx, uint8_t rx, bool passive);

#endif
