/* server.h: the boot loader on its bus. */
#ifndef OCTET_SERVER_H
#define OCTET_SERVER_H

#include "hal/boot/isotp.h"
#include "hal/boot/uds.h"

enum {
    SERVER_IDLE_MS = 5000,        /* without a request: then it starts the image, if any */
    SERVER_LAST_MS = 20           /* for the last answer to leave */
};

struct server {
    struct isotp isotp;
    struct uds uds;
    uint16_t request_id;
    bool hurries;                 /* server_work may have more to do at once */
    bool leaving;
    uint32_t leaving_ms;          /* since when */
};

void server_begin(struct server *server, struct choices *choices, uint8_t node, uint32_t now_ms);

void server_programming(struct server *server);
        /* Enters the programming session for which an image has restarted the chip, and answers the request. */

void server_take(struct server *server, const struct frame *frame, uint32_t now_ms);
        /* Handles a received frame of any kind. */

void server_send(struct server *server, struct link *link, uint32_t now_ms);
        /* Sends whatever is due. */

bool server_work(struct server *server, uint32_t now_ms);
        /* Does a step of any long operation, which may stall for as long as an erase. Call whenever no frame waits.
           False: restart the chip now. */

#endif
