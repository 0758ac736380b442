/* A user's behaviour in a flash image: it runs unchecked, and its notes go nowhere. */
#include "firmware/behaviours/behaviour.h"

const bool OWN_IS_LINKED = true;

void note(const char *text, long value);

void note(const char *text, long value)
{
    (void)text;
    (void)value;
}
