/* The values are the fuzzer's input, byte by byte, and zeros after its end. */
#include <stddef.h>

#include "tests/proof/any/any.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static const uint8_t *next;
static size_t left;

uint8_t any_u8(void)
{
    if (left == 0)
        return 0;
    left--;
    return *next++;
}

bool any_more(void)
{
    return left > 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    next = data;
    left = size;
    exercise();
    return 0;
}
