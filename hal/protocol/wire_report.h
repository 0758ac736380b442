/* wire_report.h: the messages that report the robot's state. */
#ifndef OCTET_WIRE_REPORT_H
#define OCTET_WIRE_REPORT_H

#include "hal/protocol/frames.h"

void wire_report_start(struct wire *wire);
        /* Begins a run and its first second: no report is in progress, and no other robot has sent its memory yet. */

void wire_report(struct wire *wire, const struct output *out, struct frames *frames);
        /* Writes what is due of the report: all of it if it is marked whole, else one part an output, from the output
           that brings it on. A new memory is told at once, and holds up the next part by one output. */

#endif
