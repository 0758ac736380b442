/* flash_errors.h: handles the non-maskable interrupt of flash ECC errors. */
#ifndef OCTET_FLASH_ERRORS_H
#define OCTET_FLASH_ERRORS_H

#include <stdbool.h>

bool flash_forgives(void);
        /* True: flash_read expected this error and will report it; the program continues. False: it is another error,
           or at another place. */

#endif
