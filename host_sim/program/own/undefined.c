/* What gcc and clang call where code compiled with -fsanitize=undefined does something that C does not define. */
#include <stdint.h>
#include <stdio.h>

#include "host_sim/program/own/guard.h"

/* As the compilers lay it out: each of their descriptions begins with the place. */
struct place {
    const char *file;
    uint32_t line, column;
};

struct type {
    uint16_t kind, info;
    char name[];
};

struct bounds {
    struct place place;
    const struct type *array, *index;
};

static void fail(const struct place *place, const char *what)
{
    char text[GUARD_TEXT_MAX / 2];

    snprintf(text, sizeof text, "%s:%u:%u", place->file, (unsigned)place->line, (unsigned)place->column);
    guard_fail(NULL, text, what);
}

void __ubsan_handle_out_of_bounds_abort(const struct bounds *found, uintptr_t index);

void __ubsan_handle_out_of_bounds_abort(const struct bounds *found, uintptr_t index)
{
    char what[GUARD_TEXT_MAX / 3];

    snprintf(what, sizeof what, "index %ld is outside of %s", (long)(int32_t)index, found->array->name);
    fail(&found->place, what);
}

#define FAILS(name, what)                                   \
    void __ubsan_handle_##name(const struct place *place);  \
    void __ubsan_handle_##name(const struct place *place)   \
    {                                                       \
        fail(place, what);                                  \
    }

FAILS(add_overflow_abort, "a sum that is too large for its type")
FAILS(sub_overflow_abort, "a difference that is too large for its type")
FAILS(mul_overflow_abort, "a product that is too large for its type")
FAILS(negate_overflow_abort, "a negative that is too large for its type")
FAILS(divrem_overflow_abort, "a division by zero")
FAILS(shift_out_of_bounds_abort, "a shift by more bits than there are, or of a negative number")
FAILS(builtin_unreachable, "the end of a function that must return something, or code said to be unreachable")
FAILS(vla_bound_not_positive_abort, "an array of no size")
FAILS(float_cast_overflow_abort, "a floating-point number that is too large for its type")
FAILS(load_invalid_value_abort, "a value that its type has not, such as a bool of 254: it was never set")
FAILS(invalid_builtin_abort, "a count of the bits of 0")
FAILS(nonnull_arg_abort, "a null pointer as an argument")
FAILS(nonnull_return_v1_abort, "a null pointer as a result")
FAILS(type_mismatch_v1_abort, "a pointer that is null, or points at another type")
FAILS(pointer_overflow_abort, "a pointer beyond all memory")
