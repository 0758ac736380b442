/* robot_wire.h: one tick's frames between the world and one robot. */
#ifndef OCTET_ROBOT_WIRE_H
#define OCTET_ROBOT_WIRE_H

#include "host_sim/sim/native/loop.h"

void robot_wire_senses(struct loop_robot *robot, const struct senses *senses, struct frame *out);
        /* The frame that tells a robot its senses. */

bool robot_wire_drive(const struct frame *frame, uint8_t tick, struct drive *out);
        /* Fills *out from a DRIVE. Whether it answers the senses of this tick. */

void robot_wire_report(struct loop_robot *robot, const struct frame *frame);
        /* Notes a report of this tick, and whether it says something new: more than the time, and that it was sent again.
           Of more than LOOP_FRAMES_MAX the last are kept. */

bool robot_wire_goes_on(struct loop_robot *robot, const struct frame *frame);
        /* Whether a report goes on from the last one of its kind: whole, the next by its counter, and nothing new in it but
           the time. Then it is noted. */

bool robot_wire_is_memory(const struct frame *frame);
        /* Whether it is half of some robot's memory. */

#endif
