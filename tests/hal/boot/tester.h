/* tester.h: a tester that talks to the services directly, as one behind a bus does. */
#ifndef OCTET_TESTER_H
#define OCTET_TESTER_H

#include "hal/boot/uds.h"

#include "signer.h"

extern struct uds uds;
extern struct choices choices;
extern uint8_t answer[UDS_ANSWER_MAX];
extern uint16_t answered;   /* bytes of the last answer */

void tester_power_on(void);
        /* The services begin anew, on the flash as it is. */

int ask(const uint8_t request[], uint16_t len);
        /* Has it served to the end. 0 for a positive answer or none, else the negative response code. */

#define ASK(...) ask((const uint8_t[]){__VA_ARGS__}, sizeof (const uint8_t[]){__VA_ARGS__})

int prove(void);
        /* Asks for a challenge and signs it. */

void unlock(void);
        /* Enters a programming session that is unlocked. */

struct signed_image tester_begin(void);
        /* Image 5 runs in slot 0, was confirmed, and nothing older is taken. Image 6 for the other slot. */

int erase_for(const struct signed_image *image, uint32_t from);
int announce(uint32_t from);
        /* RequestDownload. */

int download(const struct signed_image *image, uint32_t from);
        /* RequestDownload, all blocks, RequestTransferExit. */

void begin_download(const struct signed_image *image);
        /* All up to its first block. */

int check(void);

int update(const struct signed_image *image);
        /* All of it, until something is refused. */

#endif
