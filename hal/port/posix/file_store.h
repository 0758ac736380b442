/* file_store.h: the robot's memory in a file of the host: its bytes, and nothing else. */
#ifndef OCTET_FILE_STORE_H
#define OCTET_FILE_STORE_H

#include "hal/hal.h"

int file_store_load(const char *path, uint8_t memory[CELL_COUNT]);
        /* As hal_load: 1, 0 where there is no such file, or HAL_E_STORE for a file of any other size or one that
           cannot be read. What the bytes mean is not looked at. */

int file_store_save(const char *path, const uint8_t memory[CELL_COUNT]);
        /* As hal_store, through PATH.new beside it. 0: on the disk. HAL_E_STORE: the memory that was there is still there. */

#endif
