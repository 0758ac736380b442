/* fdcan_registers.h: what the tests of FDCAN's driver alone look at. */
#ifndef OCTET_FDCAN_REGISTERS_RIG_H
#define OCTET_FDCAN_REGISTERS_RIG_H

#include "can_registers.h"
#include "host_sim/emulator/models/fdcan_model.h"

extern struct fdcan can;

#endif
