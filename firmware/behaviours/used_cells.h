/* used_cells.h: the cells that the robot has used since it was blocked are praised when the way is clear, and blamed when
 * it turns about in boredom: for the behaviours that judge their memory by how it ends.
 *
 * Praise adds to a cell's confidence as much as the behaviour says: nothing, where a cell is a side and no more. */
#ifndef OCTET_USED_CELLS_H
#define OCTET_USED_CELLS_H

#include "firmware/brain.h"

bool used_cells_learn(struct brain *brain, const struct senses *senses, unsigned confidence);
        /* If a trial has just helped, stores its side with that confidence; the cell is used then. Call before the next
           action is chosen. True if so. */

void used_cells_judge(struct brain *brain, const struct action *action, uint8_t pattern, int praise);
        /* Takes note of the action that was chosen with that pattern in sight. An about-face, which takes a confidence
           of 2 from each used cell, also ends the repeat count. */

struct action used_cells_next(struct brain *brain, const struct config *config, const struct senses *senses,
                              unsigned confidence, int praise);
        /* The listing's next action, with both of these around it. */

#endif
