#include "host_sim/web/native/page.h"

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

static struct history *history_of(uint32_t robot)
{
    return &page_state()->histories[robot];
}

void page_history_begin(uint32_t robot)
{
    history_begin(history_of(robot), page_sides(robot));
}

uint32_t page_history_take(uint32_t robot, double tick)
{
    struct page *page = page_state();
    size_t count = history_take(history_of(robot), tick, page->robots[robot].rows, page->loop.ticks, page->notes);

    history_learn(history_of(robot), tick + page->loop.ticks - 1, page_sides(robot));
    return (uint32_t)count;
}

void page_history_relearn(uint32_t robot, double tick)
{
    history_relearn(history_of(robot), tick, page_sides(robot));
}

void page_history_restart(uint32_t robot)
{
    history_restart(history_of(robot), page_sides(robot));
}

void page_history_freeze(uint32_t robot, uint32_t on)
{
    history_of(robot)->frozen = on != 0;
}

const struct history_note *page_notes(void)
{
    return page_state()->notes;
}

const struct history_lesson *page_lessons(uint32_t robot)
{
    return history_of(robot)->lessons;
}

uint32_t page_lesson_count(uint32_t robot)
{
    return history_of(robot)->lesson_count;
}
