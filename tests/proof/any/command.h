/* command.h: a COMMAND with any content, whole and in its turn, for the robot of node 1. */
#ifndef OCTET_PROOF_ANY_COMMAND_H
#define OCTET_PROOF_ANY_COMMAND_H

#include "hal/link/link.h"

struct frame any_command(uint8_t owner, unsigned before);
        /* Takes seven bytes: those of the frame behind its CRC. before: commands sent so far. */

#endif
