/* page_frames.h: what goes to the robots of a page, and what they say. */
#ifndef OCTET_PAGE_FRAMES_H
#define OCTET_PAGE_FRAMES_H

#include "host_sim/web/native/page.h"

struct octet *page_octet(uint32_t robot);
        /* The robot itself. */

void page_hear(uint32_t robot, const struct frame *frame);
        /* Gives a robot a frame. What it answers waits to be taken; there is room for PAGE_WAITING_MAX frames, and those
           beyond are lost. */

bool page_take(uint32_t robot, struct frame *out);
        /* Takes and logs the oldest frame that waits. False if none does. */

#endif
