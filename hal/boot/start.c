#include "hal/boot/start.h"

#include "hal/boot/image.h"

static bool is_in(const struct choice *choice)
{
    return choice->installed >> choice->slot & 1u;
}

/* Finds the newest signed image. */
static struct choice found(const struct choice *now)
{
    struct choice choice = {.node = now->node, .bitrate = now->bitrate};
    struct image image = {0};

    for (uint8_t slot = 0; slot < SLOTS; slot++)
        if (image_verify(slot, &image) == REFUSAL_NONE) {
            choice.installed |= (uint8_t)(1u << slot);
            if (image.version >= choice.floor) {
                choice.slot = slot;
                choice.floor = image.version;
            }
        }
    return choice;
}

int start_pick(struct choices *choices)
{
    struct choice next = choices->now.installed == 0 ? found(&choices->now) : choice_started(&choices->now);
    struct image image;

    while (is_in(&next)) {
        if (image_check(next.slot, &image) == REFUSAL_NONE
            && (choices_save(choices, &next, true) == 0 || !next.trial))
            return next.slot;
        next = choice_without(&next);
    }
    return SLOT_NONE;
}
