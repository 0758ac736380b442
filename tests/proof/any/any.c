/* Each read of a volatile may bring any value. */
#include "tests/proof/any/any.h"

static volatile uint8_t anything;

uint8_t any_u8(void)
{
    return anything;
}

bool any_more(void)
{
    return anything != 0;
}
