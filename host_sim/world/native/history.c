#include "host_sim/world/native/history.h"

#include <string.h>

static int32_t pattern_of(int32_t feel)
{
    return feel >> 1 & (CELL_COUNT - 1);
}

static int32_t ones(int32_t pattern)
{
    return (pattern & 1) + (pattern >> 1 & 1) + (pattern >> 2 & 1);
}

static void forget_cells(struct history *history, const uint8_t sides[CELL_COUNT])
{
    memcpy(history->sides, sides, CELL_COUNT);
    for (unsigned cell = 0; cell < CELL_COUNT; cell++) {
        history->uses[cell] = history->by_hand[cell] = 0;
        history->learned[cell] = -1.0;
    }
    history->trial = (struct history_trial){.tick = -1.0};
    history->frozen = false;
    history->lesson_count = 0;
}

void history_begin(struct history *history, const uint8_t sides[CELL_COUNT])
{
    *history = (struct history){.action = -1, .reason = REASON_STOP};
    forget_cells(history, sides);
}

void history_restart(struct history *history, const uint8_t sides[CELL_COUNT])
{
    forget_cells(history, sides);
}

void history_pass_over(struct history *history, const struct history_tick *last, int32_t pattern)
{
    history->action = last->action;
    history->reason = last->reason;
    history->pattern = pattern;
}

/* Ends the trial that is under way with the senses that decide the next action. Null if there is none. */
static const struct history_trial *judge(struct history *history)
{
    struct history_trial *trial = &history->trial;

    if (trial->tick < 0.0 || trial->helped >= 0)
        return NULL;
    trial->helped = ones(history->pattern) < ones(trial->cell);
    trial->frozen = history->frozen;
    return trial;
}

/* What a robot may have done itself: learned from a trial that has just ended, or erased what it used. */
struct doings {
    const struct history_trial *judged;
    bool forgets;
};

static bool did_itself(const struct doings *doings, int32_t cell, uint8_t side)
{
    const struct history_trial *trial = doings->judged;

    return (trial && trial->cell == cell && trial->side == side && trial->helped == 1) || (doings->forgets && side == 0);
}

static void add_lessons(struct history *history, double tick, const uint8_t sides[CELL_COUNT], const struct doings *doings)
{
    history->lesson_count = 0;
    for (int32_t cell = 0; cell < CELL_COUNT; cell++) {
        int32_t by_hand = !did_itself(doings, cell, sides[cell]);

        if (sides[cell] == history->sides[cell])
            continue;
        history->lessons[history->lesson_count++] = (struct history_lesson){cell, sides[cell], by_hand};
        history->sides[cell] = sides[cell];
        history->learned[cell] = tick;
        history->by_hand[cell] = by_hand;
        history->uses[cell] = 0;
    }
}

void history_relearn(struct history *history, double tick, const uint8_t sides[CELL_COUNT])
{
    static const struct doings nothing;

    add_lessons(history, tick, sides, &nothing);
}

static void begin_action(struct history *history, double tick, const struct history_tick *what)
{
    history->reason = what->reason;
    if (what->reason == REASON_REMEMBERED) {
        history->uses[history->pattern]++;
    } else if (what->reason == REASON_TRIAL) {
        int32_t side = what->left_mm_s < what->right_mm_s ? SIDE_LEFT : SIDE_RIGHT;

        history->trial = (struct history_trial){tick, history->pattern, side, -1, 0};
        history->trials++;
    }
}

void history_take(struct history *history, double tick, const struct history_tick *what, const uint8_t sides[CELL_COUNT])
{
    struct doings doings = {NULL, false};
    bool begins = what->action != history->action;

    if (begins) {
        history->action = what->action;
        history->pattern = pattern_of(what->feel);
        doings.judged = judge(history);
        doings.forgets = what->reason == REASON_REMEMBERED || history->reason == REASON_REMEMBERED
                         || what->reason == REASON_BOREDOM;
    }
    add_lessons(history, tick, sides, &doings);
    if (begins)
        begin_action(history, tick, what);
}
