/* must.h: what has to hold. The fuzzer takes an abort for harm. */
#ifndef OCTET_PROOF_MUST_H
#define OCTET_PROOF_MUST_H

#include <stdbool.h>
#include <stdlib.h>

static inline void must(bool holds)
{
    if (!holds)
        abort();
}

#endif
