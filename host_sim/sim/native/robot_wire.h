/* robot_wire.h: one tick's frames between the world and one robot. */
#ifndef OCTET_ROBOT_WIRE_H
#define OCTET_ROBOT_WIRE_H

#include "host_sim/sim/native/loop.h"

void robot_wire_senses(struct loop_robot *robot, const struct senses *senses, struct frame *out);
        /* The frame that tells a robot its senses. */

bool robot_wire_drive(const struct frame *frame, uint8_t tick, struct drive *out);
        /* Fills *out from a DRIVE. Returns whether it answers the senses of this tick. */

void robot_wire_report(struct loop_robot *robot, const struct frame *frame);
        /* Records a report of this tick, and whether it brings anything new besides time and counters. Keeps the last
           LOOP_FRAMES_MAX reports. */

bool robot_wire_goes_on(struct loop_robot *robot, const struct frame *frame);
        /* Whether a report continues the last one of its kind: valid, with the next counter, and nothing new except
           the time. Records it if so. */

void robot_wire_hear_answer(struct loop_robot *robot, const struct frame *drive);
        /* Notes that the robot has answered its last senses, with this DRIVE. */

bool robot_wire_is_memory(const struct frame *frame);
        /* Whether the frame is half of a robot's memory. */

#endif
