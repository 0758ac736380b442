/* page_frames.h: frames to and from the robots of a page. */
#ifndef OCTET_PAGE_FRAMES_H
#define OCTET_PAGE_FRAMES_H

#include "host_sim/web/native/page.h"

struct octet *page_octet(uint32_t robot);
        /* The robot itself. */

void page_hear(uint32_t robot, const struct frame *frame);
        /* Sends a robot a frame. Its answers wait to be taken; there is room for PAGE_WAITING_MAX frames, and further
           ones are lost. */

bool page_take(uint32_t robot, struct frame *out);
        /* Takes and logs the oldest waiting frame. False if there is none. */

#endif
