/* page_rig.h: a page's run after page_open. */
#ifndef OCTET_PAGE_RIG_H
#define OCTET_PAGE_RIG_H

#include "tests/test.h"
#include "host_sim/web/native/page.h"
#include "octet.h"

enum { ROBOTS = 2, SEED = 7 };

void start(uint32_t robot, enum profile profile);
        /* Starts the robot, which must succeed, and clears the log. */

void put_bytes(const uint8_t bytes[PAGE_BYTES]);
        /* Sets page_bytes, as JavaScript does. */

unsigned logged(const char *id);
        /* How many frames with this identifier, three hex digits, stand in the log. */

#endif
