/* can_registers.h: the model of a controller behind registers in the test's memory. What the driver has written there reaches
 * the model, and time passes, whenever the driver asks for the time. */
#ifndef OCTET_CAN_REGISTERS_H
#define OCTET_CAN_REGISTERS_H

#include "hal/stm32/chip.h"
#include "host_sim/emulator/models/can_node.h"

enum { LOOK_US = 50 };   /* from one look at the clock to the next */

extern struct can_wire wire;
extern struct clocks machine;

/* One for each controller. */
struct can_memory {
    struct can_node *node;
    volatile uint32_t *words[2];   /* the registers, and a message RAM or nothing */
    uint32_t count[2];
    uint32_t offset;               /* of that RAM */
    bool (*shows)(uint32_t offset, uint32_t *out);   /* what the driver can read there; false: nothing that changes */
    void (*open)(void);            /* as a boot loader may leave it */
    void (*prepare)(uint32_t offset);   /* the driver has written there */
};

extern const struct can_memory CAN_MEMORY;

void registers_reset(void);
        /* A chip that has just been reset, as its boot loader may leave it, on a quiet bus. */

void registers_show(void);
        /* The driver can read what the model has. */

void registers_pass_us(uint32_t us);
        /* What the driver has written takes effect, and time passes. */

#endif
