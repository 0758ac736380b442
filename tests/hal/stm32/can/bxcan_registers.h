/* bxcan_registers.h: the model of bxCAN behind registers in the test's memory. What the driver has written there reaches the
 * model, and time passes, whenever the driver asks for the time. */
#ifndef OCTET_BXCAN_REGISTERS_H
#define OCTET_BXCAN_REGISTERS_H

#include "hal/stm32/machine.h"
#include "host_sim/emulator/models/bxcan_model.h"

enum { LOOK_US = 50 };   /* from one look at the clock to the next */

extern struct can_wire wire;
extern struct bxcan can;
extern struct clocks machine;

void registers_reset(void);
        /* A chip that has just been reset, as its boot loader may leave it, on a quiet bus. */

void registers_leave_filters(uint32_t modes, uint32_t scales, uint32_t bank);
        /* All filters active, as a boot loader may leave them: FM1R, FS1R, and each word of each bank. */

void registers_pass_us(uint32_t us);
        /* What the driver has written takes effect, and time passes. */

#endif
