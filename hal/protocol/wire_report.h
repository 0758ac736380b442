/* wire_report.h: the messages that say how the robot is. */
#ifndef OCTET_WIRE_REPORT_H
#define OCTET_WIRE_REPORT_H

#include "hal/protocol/frames.h"

void wire_report_start(struct wire *wire);
        /* A run begins, and a second with it: no report is under way, and no other robot has told its memory in it. */

void wire_report(struct wire *wire, const struct output *out, struct frames *frames);
        /* Writes what is due of the report: all of it if it is marked whole, else one part an output, from the output that
           brings it on. A new memory is told at once, and holds up the next part by one output. */

#endif
