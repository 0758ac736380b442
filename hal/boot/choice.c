#include "hal/boot/choice.h"

enum { HALF_OF_SLOWEST = 62500, FORMAT = 0xC1, SLOT_AT = 2, TRIAL_AT = 3, STARTS_AT = 4 };

static uint8_t bit(unsigned slot)
{
    return (uint8_t)(1u << slot);
}

static bool is_in(const struct choice *choice, unsigned slot)
{
    return choice->installed & bit(slot);
}

static void pack(const struct choice *choice, uint8_t out[CELL_COUNT])
{
    for (unsigned i = 0; i < 4; i++)
        out[i] = (uint8_t)(choice->floor >> 8 * i);
    out[4] = (uint8_t)(choice->installed | (unsigned)choice->slot << SLOT_AT | (choice->trial ? 1u : 0u) << TRIAL_AT |
                       (unsigned)choice->starts << STARTS_AT);
    out[5] = choice->node;
    out[6] = choice->bitrate;
    out[7] = FORMAT;
}

static struct choice unpack(const uint8_t bytes[CELL_COUNT])
{
    struct choice choice = {
        .installed = bytes[4] & 3u,
        .slot = bytes[4] >> SLOT_AT & 1u,
        .trial = bytes[4] >> TRIAL_AT & 1u,
        .starts = bytes[4] >> STARTS_AT,
        .node = bytes[5],
        .bitrate = bytes[6] < BITRATES ? bytes[6] : 0,
    };

    for (unsigned i = 0; i < 4; i++)
        choice.floor |= (uint32_t)bytes[i] << 8 * i;
    return choice;
}

int choices_open(struct choices *choices, unsigned first_page)
{
    uint8_t bytes[CELL_COUNT] = {0};
    bool found = flash_store_open_at(&choices->store, first_page, bytes) == 1 && bytes[7] == FORMAT;

    choices->now = found ? unpack(bytes) : (struct choice){.slot = 0};
    return found ? 1 : 0;
}

int choices_save(struct choices *choices, const struct choice *next, bool may_erase)
{
    uint8_t bytes[CELL_COUNT];
    int result;

    pack(next, bytes);
    result = flash_store_save(&choices->store, bytes, may_erase);
    if (result == 0)
        choices->now = *next;
    return result;
}

uint32_t choice_bitrate(const struct choice *choice)
{
    return choice->bitrate == 0 ? 0 : (uint32_t)HALF_OF_SLOWEST << choice->bitrate;
}

uint8_t choice_bitrate_place(uint32_t bitrate)
{
    struct choice choice = {.bitrate = 0};

    while (choice.bitrate < BITRATES && choice_bitrate(&choice) != bitrate)
        choice.bitrate++;
    return choice.bitrate;
}

const char *choice_link(const struct choice *choice)
{
    static const char *const names[BITRATES] = {"", "125000", "250000", "500000", "1000000"};

    return names[choice->bitrate];
}

uint8_t choice_free_slot(const struct choice *choice)
{
    return is_in(choice, choice->slot) && !choice->trial ? 1 - choice->slot : choice->slot;
}

/* Falls back from the chosen image to the other one, which was once confirmed. */
struct choice choice_without(const struct choice *choice)
{
    struct choice next = *choice;

    next.installed &= (uint8_t)~bit(choice->slot);
    next.trial = false;
    next.starts = 0;
    if (is_in(choice, 1u - choice->slot))
        next.slot = 1 - choice->slot;
    return next;
}

struct choice choice_cleared(const struct choice *choice)
{
    struct choice next = *choice;

    if (choice_free_slot(choice) == choice->slot)
        return choice_without(choice);
    next.installed = bit(choice->slot);
    return next;
}

struct choice choice_installed(const struct choice *choice)
{
    struct choice next = *choice;

    next.slot = choice_free_slot(choice);
    next.installed |= bit(next.slot);
    next.trial = true;
    next.starts = 0;
    return next;
}

struct choice choice_confirmed(const struct choice *choice, uint32_t version)
{
    struct choice next = *choice;

    next.trial = false;
    next.starts = 0;
    if (next.floor < version)
        next.floor = version;
    return next;
}

/* Without an image to fall back to, an image stays on trial. */
struct choice choice_started(const struct choice *choice)
{
    struct choice next = *choice;

    if (!choice->trial)
        return next;
    if (choice->starts < TRIAL_STARTS)
        next.starts++;
    else if (is_in(choice, 1u - choice->slot))
        next = choice_without(choice);
    return next;
}
