#include "host_sim/web/native/page.h"

enum { TRIAL_NUMBERS = 5, LESSON_NUMBERS = 3 };

static struct history *history_of(uint32_t robot)
{
    return &page_state()->histories[robot];
}

static const int16_t *row_of(uint32_t robot, uint32_t tick)
{
    return page_rows(robot) + (size_t)tick * LOOP_ROW;
}

static struct history_tick tick_of(const int16_t *row)
{
    return (struct history_tick){row[ROW_FEEL], row[ROW_LEFT], row[ROW_RIGHT], row[ROW_REASON], row[ROW_ACTION]};
}

void page_history_begin(uint32_t robot)
{
    history_begin(history_of(robot), page_bytes());
}

void page_history_take(uint32_t robot, double number, uint32_t tick)
{
    struct history_tick what = tick_of(row_of(robot, tick));

    history_take(history_of(robot), number, &what, page_bytes());
}

void page_history_pass_over(uint32_t robot, uint32_t tick)
{
    struct history_tick last = tick_of(row_of(robot, tick));

    history_pass_over(history_of(robot), &last, row_of(robot, tick)[ROW_PATTERN]);
}

void page_history_relearn(uint32_t robot, double number)
{
    history_relearn(history_of(robot), number, page_bytes());
}

void page_history_restart(uint32_t robot)
{
    history_restart(history_of(robot), page_bytes());
}

void page_history_freeze(uint32_t robot, uint32_t on)
{
    history_of(robot)->frozen = on != 0;
}

const double *page_history(uint32_t robot)
{
    static double out[TRIAL_NUMBERS + 1 + LESSON_NUMBERS * CELL_COUNT];
    const struct history *history = history_of(robot);
    const struct history_trial *trial = &history->trial;
    double *at = out;

    *at++ = trial->tick;
    *at++ = trial->cell;
    *at++ = trial->side;
    *at++ = trial->helped;
    *at++ = trial->frozen;
    *at++ = history->lesson_count;
    for (uint32_t i = 0; i < history->lesson_count; i++) {
        *at++ = history->lessons[i].cell;
        *at++ = history->lessons[i].side;
        *at++ = history->lessons[i].by_hand;
    }
    return out;
}
