#include "host_sim/web/native/page.h"

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
