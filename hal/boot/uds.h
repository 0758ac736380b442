/* uds.h: the UDS services (ISO 14229-1) for updates. docs/update.md lists them, and what they refuse and why.
 *
 * Requests and answers are complete messages; isotp.h handles ISO-TP. What takes longer than a tester waits is first
 * answered with "response pending", then done in steps. */
#ifndef OCTET_UDS_H
#define OCTET_UDS_H

#include "hal/boot/image.h"

enum {
    UDS_ANSWER_MAX = 72,
    UDS_CHALLENGE = 16,
    UDS_BLOCK_MAX = 1026,         /* of a TransferData request, service and number included */
    UDS_SESSION_MS = 5000,        /* the programming session ends after this time without a request */
    UDS_TRIES = 3,                /* wrong proofs in a row, */
    UDS_DELAY_MS = 10000          /* and the lockout after them */
};

enum uds_work { WORK_NONE, WORK_ERASE, WORK_CHECK, WORK_KINDS };

struct uds {
    struct choices *choices;
    uint32_t asked_ms;            /* time of the last request */
    uint32_t wrong_ms;            /* time of the last wrong proof */
    bool programming, unlocked, asked, restart;
    uint8_t wrong;                /* proofs in a row */
    uint8_t challenge[UDS_CHALLENGE];
    enum uds_work work;
    uint8_t why;                  /* an enum refusal: why the last image was refused */
    uint8_t slot;                 /* being written */
    struct image image;           /* announced for it: */
    uint8_t header[IMAGE_HEADER];
    uint32_t from;                /* where this download begins, bytes from the start of the slot */
    bool erased;                  /* the slot is, from there on */
    bool loading, loaded;
    bool took;                    /* a block of this download */
    uint8_t number;               /* of the next block */
    uint32_t at;                  /* where it goes, or the next address to erase */
    uint32_t ahead;               /* bytes from there on that are written already */
};

void uds_begin(struct uds *uds, struct choices *choices, uint32_t now_ms);
        /* Begins in the default session. choices must outlive it. */

uint16_t uds_serve(struct uds *uds, const uint8_t request[], uint16_t len, uint8_t answer[UDS_ANSWER_MAX]);
        /* Handles a request of 1..UDS_BLOCK_MAX bytes. Returns the length of the answer, or 0 for none. While
           uds->work is not WORK_NONE, the answer is "busy". */

bool uds_ahead(struct uds *uds, const uint8_t request[], uint16_t len);
        /* Handles the first 2..UDS_BLOCK_MAX bytes of an incomplete request: if it is the block that is due, writes
           the next unit of it, in under 0.2 ms. False: there was nothing to write. */

uint16_t uds_do(struct uds *uds, uint8_t answer[UDS_ANSWER_MAX]);
        /* Does a step of uds->work, at most 0.1 s. Returns the length of the answer once it is done, else 0. */

void uds_pass(struct uds *uds, uint32_t now_ms, bool asked);
        /* Call as time passes, with or without a request. Ends a session that has timed out. */

/* Provided by the platform. */
void boot_random(uint8_t out[UDS_CHALLENGE]);
        /* Fresh random numbers, as good as the chip provides. */

#endif
