/* flash_errors.h: what becomes of a non-maskable interrupt. */
#ifndef OCTET_FLASH_ERRORS_H
#define OCTET_FLASH_ERRORS_H

#include <stdbool.h>

bool flash_forgives(void);
        /* True: flash_read has met what it was on the watch for, and will say so; the program goes on. False: it is
           something else, or somewhere else. */

#endif
