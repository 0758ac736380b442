/* memcpy and memset, which the compiler calls for structs, and memcmp. Ours handle short blocks, with a quarter of
 * the code of the library's. */
#include <stdint.h>
#include <string.h>

typedef uint32_t word __attribute__((may_alias, aligned(1)));   /* by bytes where a core has no unaligned writes */

void *memcpy(void *restrict to, const void *restrict from, size_t count)
{
    char *at = to;

    for (const char *next = from; count > 0; count--)
        *at++ = *next++;
    return to;
}

int memcmp(const void *one, const void *other, size_t count)
{
    const uint8_t *a = one;
    const uint8_t *b = other;

    for (; count > 0; a++, b++, count--)
        if (*a != *b)
            return *a - *b;
    return 0;
}

/* Four bytes at a time, since cleared blocks are longer than copied ones. */
void *memset(void *to, int value, size_t count)
{
    char *at = to;
    char *end = at + count;

    for (; end - at >= (int)sizeof(word); at += sizeof(word))
        *(word *)at = 0x01010101u * (uint8_t)value;
    while (at < end)
        *at++ = (char)value;
    return to;
}
