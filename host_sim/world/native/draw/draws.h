/* draws.h: random numbers, the same as random.Random(text).random() in every version of Python. */
#ifndef OCTET_DRAWS_H
#define OCTET_DRAWS_H

#include <stdint.h>

enum { DRAWS_WORDS = 624, DRAWS_TEXT_MAX = 100 };

struct draws {   /* a Mersenne Twister, MT19937 */
    uint32_t words[DRAWS_WORDS];
    uint32_t used;   /* of the words, since they were made */
};

void draws_seed(struct draws *draws, const char *text);
        /* Seeds the generator with a text of at most DRAWS_TEXT_MAX characters; further ones are ignored. */

double draws_next(struct draws *draws);
        /* A number from 0 up to, but not including, 1. */

double draws_between(struct draws *draws, double low, double high);
        /* A uniform number from low to high. */

#endif
