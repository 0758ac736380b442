#include "host_sim/web/native/page_frames.h"

#include <string.h>

#include "firmware/memory/memory.h"

const uint8_t *page_memory(uint32_t robot)
{
    return page_octet(robot)->robot.brain.memory.cell;
}

const uint8_t *page_sides(uint32_t robot)
{
    static struct memory sides;

    memcpy(sides.cell, page_memory(robot), sizeof sides.cell);
    (void)memory_translate(&sides, MEMORY_KIND_SIDES);
    return sides.cell;
}

static enum memory_kind kind_of(uint32_t robot)
{
    return (enum memory_kind)BRAIN_MEMORY_KINDS[page_octet(robot)->robot.brain.profile];
}

void page_write_side(uint32_t robot, uint32_t pattern, uint32_t side)
{
    struct memory memory;

    memcpy(memory.cell, page_bytes(), sizeof memory.cell);
    memory_put(&memory, kind_of(robot), (uint8_t)pattern, (enum side)side);
    memcpy(page_bytes(), memory.cell, sizeof memory.cell);
}

bool page_translate(uint32_t robot)
{
    struct memory memory;

    if (!memory_adopt(&memory, page_bytes()))
        return false;
    (void)memory_translate(&memory, kind_of(robot));
    memcpy(page_bytes(), memory.cell, sizeof memory.cell);
    return true;
}
