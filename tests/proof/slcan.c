/* slcan: whatever bytes come, and whatever frame is written after each line. */
#include "hal/link/slcan.h"
#include "tests/proof/any/any.h"

static void write_any_frame(void)
{
    char text[SLCAN_TEXT_MAX];
    struct frame frame = {.id = any_u32(), .len = any_between(0, sizeof frame.data)};

    for (unsigned i = 0; i < sizeof frame.data; i++)
        frame.data[i] = any_u8();
    (void)slcan_encode(text, &frame);
}

void exercise(void)
{
    struct slcan_decoder decoder = {.len = 0};
    struct frame frame;

    while (any_more())
        if (slcan_decode(&decoder, (char)any_u8(), &frame) != SLCAN_NOTHING)
            write_any_frame();
}
