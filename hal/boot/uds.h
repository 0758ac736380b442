/* uds.h: the services of UDS (ISO 14229-1) that an update takes. docs/update.md lists them, with all that they refuse and why.
 *
 * Requests come in whole, answers go out whole: ISO-TP is somebody else's. What takes longer than a tester waits is answered
 * with "response pending" first and then done in steps. */
#ifndef OCTET_UDS_H
#define OCTET_UDS_H

#include "hal/boot/image.h"

enum {
    UDS_ANSWER_MAX = 72,
    UDS_CHALLENGE = 16,
    UDS_BLOCK_MAX = 1026,         /* of a TransferData request, service and number included */
    UDS_SESSION_MS = 5000,        /* without a request for so long, the programming session ends */
    UDS_TRIES = 3,                /* wrong proofs, */
    UDS_DELAY_MS = 10000          /* and how long nobody is asked for one after that */
};

enum uds_work { WORK_NONE, WORK_ERASE, WORK_CHECK, WORK_KINDS };

struct uds {
    struct choices *choices;
    uint32_t asked_ms;            /* when the last request came */
    uint32_t wrong_ms;            /* when the last wrong proof came */
    bool programming, unlocked, asked, restart;
    uint8_t wrong;                /* proofs in a row */
    uint8_t challenge[UDS_CHALLENGE];
    enum uds_work work;
    uint8_t why;                  /* an enum refusal: why the last image was not taken */
    uint8_t slot;                 /* that is written to */
    struct image image;           /* announced for it: */
    uint8_t header[IMAGE_HEADER];
    uint32_t from;                /* where the image goes on, bytes from the begin of the slot */
    bool erased;                  /* the slot is, from there on */
    bool loading, loaded;
    bool took;                    /* a block of this download */
    uint8_t number;               /* of the block that comes next */
    uint32_t at;                  /* where it goes, or what is erased next */
    uint32_t ahead;               /* bytes from there on that are written already */
};

void uds_begin(struct uds *uds, struct choices *choices, uint32_t now_ms);
        /* In the default session. choices outlives it. */

uint16_t uds_serve(struct uds *uds, const uint8_t request[], uint16_t len, uint8_t answer[UDS_ANSWER_MAX]);
        /* A request of 1..UDS_BLOCK_MAX bytes. Returns the length of the answer, or 0 for none. While uds->work is not
           WORK_NONE, requests are answered with "busy". */

bool uds_ahead(struct uds *uds, const uint8_t request[], uint16_t len);
        /* The first 2..UDS_BLOCK_MAX bytes of a request that is still coming are there. If they are of the block that is due, its
           next unit is written meanwhile, in under 0.2 ms. False: there was none to be written. */

uint16_t uds_do(struct uds *uds, uint8_t answer[UDS_ANSWER_MAX]);
        /* A step of the work that is under way, up to 0.1 s. The length of the answer once it is done, else 0. */

void uds_pass(struct uds *uds, uint32_t now_ms, bool asked);
        /* Time has passed, and a request has come or not. Ends a session that nobody keeps up. */

/* The platform's. */
void boot_random(uint8_t out[UDS_CHALLENGE]);
        /* Numbers that nobody saw before, as well as the chip can. */

#endif
