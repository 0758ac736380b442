/* used_cells.h: credit assignment for the behaviours that judge their memory by the outcome. The cells used since the
 * robot was blocked are praised when the way is clear, and blamed when it turns about in boredom.
 *
 * The behaviour says how much praise adds to a cell's confidence: 0 if its cells hold only a side. */
#ifndef OCTET_USED_CELLS_H
#define OCTET_USED_CELLS_H

#include "firmware/brain.h"

bool used_cells_learn(struct brain *brain, const struct senses *senses, unsigned confidence);
        /* If a trial has just helped, stores its side with that confidence, marks the cell as used and returns true.
           Call before the next action is chosen. */

void used_cells_judge(struct brain *brain, const struct action *action, uint8_t pattern, int praise);
        /* Notes the action chosen for that pattern. An about-face lowers the confidence of each used cell by 2 and
           resets the repeat count. */

struct action used_cells_next(struct brain *brain, const struct config *config, const struct senses *senses,
                              unsigned confidence, int praise);
        /* The listing's next action, between calls of the two functions above. */

#endif
