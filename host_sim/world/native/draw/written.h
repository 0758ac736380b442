/* written.h: a world as a person wrote it, unchecked, and what is wrong with it. docs/worlds.md explains its keys. */
#ifndef OCTET_WRITTEN_H
#define OCTET_WRITTEN_H

#include <stdbool.h>
#include <stdint.h>

#include "host_sim/world/native/draw/layout.h"

enum { WRITTEN_TEXT_MAX = 200, WRITTEN_VALUES_MAX = 8 };

enum written_key { WRITTEN_SIZE, WRITTEN_START, WRITTEN_FOOD, WRITTEN_BARS };   /* food and bars are lists */

struct written_fault {
    int32_t key;     /* where it is: an enum written_key, */
    int32_t entry;   /* and the entry of its list, from 0; -1: all of it */
    uint32_t value_count;
    double values[WRITTEN_VALUES_MAX];
    char text[WRITTEN_TEXT_MAX];   /* the message; each %g stands for the next of the values */
};

bool written_fails(struct written_fault *fault, enum written_key key, int32_t entry, const char *words, ...);
        /* Fills in the fault, and returns false. Words that do not begin with a letter follow the name of the entry.
           The arguments are a text for each %s, and for each %g a double, which goes to the values. */

enum { WRITTEN_BARS_MAX = 40, WRITTEN_FOOD_MAX = LAYOUT_FOOD_MAX, WRITTEN_NUMBERS_MAX = 4 };
enum { WRITTEN_SIZE_MIN_MM = 600, WRITTEN_WIDTH_MAX_MM = 6000, WRITTEN_HEIGHT_MAX_MM = 5000 };
enum { WRITTEN_CELLS_MAX = 48884 };   /* reach_size of the largest world */
enum { WRITTEN_LEFT_OUT = -2, WRITTEN_NO_LIST = -1 };   /* in place of a count */

/* Such as [x, y]. */
struct written_entry {
    int32_t count;   /* of numbers, including those beyond WRITTEN_NUMBERS_MAX */
    double numbers[WRITTEN_NUMBERS_MAX];   /* NaN: no number; the start's heading in degrees */
};

struct written {
    int32_t food_count;   /* of entries, including those beyond the arrays */
    int32_t bar_count;
    struct written_entry size;
    struct written_entry start;
    struct written_entry food[WRITTEN_FOOD_MAX];
    struct written_entry bars[WRITTEN_BARS_MAX];
};

void written_clear(struct written *written);
        /* Clears it. */

void written_list(struct written *written, enum written_key key, int32_t count);
        /* Sets the number of entries of a list, or WRITTEN_NO_LIST. */

struct written_entry *written_entry(struct written *written, enum written_key key, uint32_t index);
        /* An entry; null beyond the arrays. index is 0 for size and start. */

bool written_check(const struct written *written, struct layout_params params, struct reach *reach,
                   struct written_fault *out);
        /* Whether it is a fair world; if not, *out is its first fault. params apply to a world that gives no size;
           reach is working memory for WRITTEN_CELLS_MAX cells. */

void written_lay_out(const struct written *written, struct layout *out);
        /* Its bars and its food; it has no fault. */

#endif
