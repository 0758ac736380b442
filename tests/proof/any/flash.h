/* flash.h: a flash that may hold anything, and each of whose operations may fail. */
#ifndef OCTET_ANY_FLASH_H
#define OCTET_ANY_FLASH_H

#include "hal/flash_store/flash.h"

extern const unsigned ANY_FLASH_PAGES;   /* as many as the part that is proved may use */

#endif
