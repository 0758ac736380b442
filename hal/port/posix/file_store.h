/* file_store.h: the robot's memory in a file on the host, which holds just the eight bytes. */
#ifndef OCTET_FILE_STORE_H
#define OCTET_FILE_STORE_H

#include "hal/hal.h"

int file_store_load(const char *path, uint8_t memory[CELL_COUNT]);
        /* As hal_load: 1, 0 if there is no such file, or HAL_E_STORE if it cannot be read or has another size. The
           bytes are not interpreted. */

int file_store_save(const char *path, const uint8_t memory[CELL_COUNT]);
        /* As hal_store, by writing PATH.new and renaming it. 0: on disk. HAL_E_STORE: the old memory remains. */

#endif
