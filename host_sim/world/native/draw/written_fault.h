/* written_fault.h: what is wrong with a world that a person wrote, in words. */
#ifndef OCTET_WRITTEN_FAULT_H
#define OCTET_WRITTEN_FAULT_H

#include <stdbool.h>
#include <stdint.h>

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

#endif
