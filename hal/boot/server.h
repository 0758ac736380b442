/* server.h: the boot loader on its bus. */
#ifndef OCTET_SERVER_H
#define OCTET_SERVER_H

#include "hal/boot/isotp.h"
#include "hal/boot/uds.h"

enum {
    UPDATE_REQUEST_ID = 0x6E0,    /* and the node: 0x6E1..0x6FF. As low as they come: an update gives way to robots that drive */
    UPDATE_ANSWER_ID = 0x060,     /* 0x061..0x07F: short, and seldom */
    SERVER_IDLE_MS = 5000,        /* without a request; then an image is started, if there is one */
    SERVER_LAST_MS = 20           /* for the last answer to leave */
};

struct server {
    struct isotp isotp;
    struct uds uds;
    uint16_t request_id;
    bool hurries;                 /* server_work may find something to do at once */
    bool leaving;
    uint32_t leaving_ms;          /* since when */
};

void server_begin(struct server *server, struct choices *choices, uint8_t node, uint32_t now_ms);

void server_programming(struct server *server);
        /* An image that was asked for a programming session has restarted the chip for it: enters it, and answers. */

void server_take(struct server *server, const struct frame *frame, uint32_t now_ms);
        /* A frame has come, of whatever kind. */

void server_send(struct server *server, struct link *link, uint32_t now_ms);
        /* Sends what there is to be sent. */

bool server_work(struct server *server, uint32_t now_ms);
        /* To be called whenever no frame waits; does a step of what takes long, which may stall for as long as an erase. False:
           it is time to restart the chip. */

#endif
