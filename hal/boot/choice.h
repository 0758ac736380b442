/* choice.h: which image starts, and what else has to outlive an update: one record of eight bytes, appended as the flash
 * store appends a memory. Nothing else tells the boot loader what to do, so nothing can be half done. */
#ifndef OCTET_CHOICE_H
#define OCTET_CHOICE_H

#include "hal/flash_store/flash_store.h"

enum { SLOTS = 2, TRIAL_STARTS = 3, SLOT_NONE = -1, BITRATES = 5 };

struct choice {
    uint32_t floor;      /* images with lower versions are refused */
    uint8_t installed;   /* bit s: the image in slot s was found to be signed, and its slot not erased since */
    uint8_t slot;        /* the one that starts: 0 or 1 */
    bool trial;          /* its image has not been confirmed yet */
    uint8_t starts;      /* of an image on trial so far, 0..TRIAL_STARTS */
    uint8_t node;        /* 1..NODE_MAX; 0: as built */
    uint8_t bitrate;     /* of the bus: a place in choice_bitrate's row, under BITRATES; 0: as built */
};

struct choices {
    struct flash_store store;
    struct choice now;       /* as stored, or all zeros */
};

int choices_open(struct choices *choices, unsigned first_page);
        /* Reads the newest record from two pages. 1, or 0 where there is none, or none that can be understood. */

int choices_save(struct choices *choices, const struct choice *next, bool may_erase);
        /* As flash_store_save; choices->now is *next only if that returned 0. */

uint32_t choice_bitrate(const struct choice *choice);
        /* bit/s; 0: as built. */

uint8_t choice_bitrate_place(uint32_t bitrate);
        /* The place of a bit rate; BITRATES for one that is none. */

const char *choice_link(const struct choice *choice);
        /* The same, as link_open of a CAN controller takes it. */

uint8_t choice_free_slot(const struct choice *choice);
        /* The slot that an update writes to: never that of a confirmed image, unless there is none in it. */

struct choice choice_cleared(const struct choice *choice);
        /* What holds while the free slot is written to: another image, if there is one, starts. */

struct choice choice_installed(const struct choice *choice);
        /* What holds once the free slot has a signed image: it is on trial. To be called with what choice_cleared gave. */

struct choice choice_confirmed(const struct choice *choice, uint32_t version);
        /* What holds once the image on trial, of that version, has proven itself. */

struct choice choice_started(const struct choice *choice);
        /* What has to be stored before the chosen image starts: one start more, or the way back if it had its three. */

struct choice choice_without(const struct choice *choice);
        /* What holds once the chosen image was found damaged. */

#endif
