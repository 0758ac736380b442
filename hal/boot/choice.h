/* choice.h: which image starts, and other settings that must survive an update: one record of eight bytes, appended
 * as the flash store appends a memory. It is all that the boot loader stores, so that every change is atomic. */
#ifndef OCTET_CHOICE_H
#define OCTET_CHOICE_H

#include "hal/flash_store/flash_store.h"

enum { SLOTS = 2, TRIAL_STARTS = 3, SLOT_NONE = -1, BITRATES = 5 };

struct choice {
    uint32_t floor;      /* images with lower versions are refused */
    uint8_t installed;   /* bit s: the image in slot s has a valid signature, and its slot was not erased since */
    uint8_t slot;        /* the slot that starts: 0 or 1 */
    bool trial;          /* its image has not been confirmed yet */
    uint8_t starts;      /* starts of the image on trial so far, 0..TRIAL_STARTS */
    uint8_t node;        /* 1..NODE_MAX; 0: as built */
    uint8_t bitrate;     /* index into choice_bitrate's table, below BITRATES; 0: as built */
};

struct choices {
    struct flash_store store;
    struct choice now;       /* as stored, or all zeros */
};

int choices_open(struct choices *choices, unsigned first_page);
        /* Reads the newest record from two pages. Returns 1, or 0 if there is none or it is not valid. */

int choices_save(struct choices *choices, const struct choice *next, bool may_erase);
        /* As flash_store_save; sets choices->now to *next only if that returned 0. */

uint32_t choice_bitrate(const struct choice *choice);
        /* bit/s; 0: as built. */

uint8_t choice_bitrate_place(uint32_t bitrate);
        /* The index of a bit rate; BITRATES if it is not in the table. */

const char *choice_link(const struct choice *choice);
        /* The bit rate, as link_open of a CAN controller takes it. */

uint8_t choice_free_slot(const struct choice *choice);
        /* The slot that an update writes to: the chosen one if its image is missing or on trial, else the other. */

struct choice choice_cleared(const struct choice *choice);
        /* The record while the free slot is being written: the other image, if any, starts. */

struct choice choice_installed(const struct choice *choice);
        /* The record once the free slot has a signed image: it is on trial. Takes the result of choice_cleared. */

struct choice choice_confirmed(const struct choice *choice, uint32_t version);
        /* The record once the image on trial, of that version, is confirmed. */

struct choice choice_started(const struct choice *choice);
        /* The record to store before the chosen image starts: one more start, or a rollback after three. */

struct choice choice_without(const struct choice *choice);
        /* The record once the chosen image is found damaged. */

#endif
