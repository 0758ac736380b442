/* bxcan_registers.h: what the tests of the bxCAN's driver alone look at. */
#ifndef OCTET_BXCAN_REGISTERS_H
#define OCTET_BXCAN_REGISTERS_H

#include "can_registers.h"
#include "host_sim/emulator/models/bxcan_model.h"

extern struct bxcan can;

void registers_leave_filters(uint32_t modes, uint32_t scales, uint32_t bank);
        /* All filters active, as a boot loader may leave them: FM1R, FS1R, and each word of each bank. */

#endif
