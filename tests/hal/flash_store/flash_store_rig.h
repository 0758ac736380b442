/* flash_store_rig.h: a store in a flash that fails as told, and what a start finds in it. */
#ifndef OCTET_FLASH_STORE_RIG_H
#define OCTET_FLASH_STORE_RIG_H

#include "hal/flash_store/flash_store.h"

#include "fake_flash.h"

extern const struct fake_flash_kind KINDS[5];

#define FOR_EACH_KIND for (kind = KINDS; kind < KINDS + sizeof KINDS / sizeof KINDS[0]; kind++)

enum { CHANGES = FAKE_RECORDS - 1 };   /* of a page, beside its mark */

extern const struct fake_flash_kind *kind;

extern struct flash_store store;

extern uint8_t found[CELL_COUNT];

const uint8_t *memory_number(unsigned n);

int start(void);

int save(unsigned n);

void save_many(unsigned count);

void assert_found(unsigned n);

#endif
