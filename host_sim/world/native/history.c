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

static void forget_doings(struct history *history)
{
    history->used = -1;
    history->judged = (struct history_trial){.tick = -1.0};
    history->forgets = false;
}

void history_restart(struct history *history, const uint8_t sides[CELL_COUNT])
{
    memcpy(history->sides, sides, CELL_COUNT);
    for (unsigned cell = 0; cell < CELL_COUNT; cell++) {
        history->uses[cell] = history->by_hand[cell] = 0;
        history->learned[cell] = -1.0;
    }
    history->trial = (struct history_trial){.tick = -1.0};
    history->frozen = false;
    history->lesson_count = 0;
    forget_doings(history);
}

void history_begin(struct history *history, const uint8_t sides[CELL_COUNT])
{
    *history = (struct history){.action = -1, .reason = REASON_STOP};
    history_restart(history, sides);
}

/* Ends the current trial with the senses that decide the next action. */
static void judge(struct history *history)
{
    struct history_trial *trial = &history->trial;

    if (trial->tick < 0.0 || trial->helped >= 0)
        return;
    trial->helped = ones(history->pattern) < ones(trial->cell);
    trial->frozen = history->frozen;
    history->judged = *trial;
}

static void begin_action(struct history *history, double tick, const int16_t *row)
{
    int32_t reason = row[ROW_REASON];

    history->action = row[ROW_ACTION];
    history->pattern = pattern_of(row[ROW_FEEL]);
    judge(history);
    history->forgets = reason == REASON_REMEMBERED || history->reason == REASON_REMEMBERED
                    || reason == REASON_BOREDOM;
    history->reason = reason;
    if (reason == REASON_REMEMBERED) {
        history->used = history->pattern;
        history->uses[history->pattern]++;
    } else if (reason == REASON_TRIAL) {
        int32_t side = row[ROW_LEFT_MM_S] < row[ROW_RIGHT_MM_S] ? SIDE_LEFT : SIDE_RIGHT;

        history->trial = (struct history_trial){tick, history->pattern, side, -1, 0};
        history->trials++;
    }
}

static struct history_note note(const struct history *history, double tick)
{
    int32_t cell = history->pattern;

    return (struct history_note){
        tick, history->reason, cell, history->uses[cell], history->by_hand[cell], history->learned[cell],
        history->trial,
    };
}

static bool is_noted(const struct history *history)
{
    return history->judged.tick >= 0.0 || history->reason == REASON_REMEMBERED || history->reason == REASON_TRIAL
        || history->reason == REASON_BOREDOM;
}

size_t history_take(struct history *history, double tick, int16_t *rows, size_t ticks, struct history_note *notes)
{
    size_t count = 0;

    for (size_t i = 0; i < ticks; i++) {
        int16_t *row = rows + i * ROW_COUNT;

        forget_doings(history);
        if (row[ROW_ACTION] != history->action) {
            begin_action(history, tick + (double)i, row);
            if (is_noted(history))
                notes[count++] = note(history, tick + (double)i);
        }
        row[ROW_PATTERN] = (int16_t)history->pattern;
        row[ROW_FROZEN] = history->frozen;
    }
    return count;
}

static bool is_of_one_side(int32_t pattern)
{
    return ((pattern ^ pattern >> 2) & 1) != 0;
}

/* Whether a trial taught that turn: in its own cell or, if the robot generalizes, all of an obstacle on one side. */
static bool taught(const struct history_trial *trial, int32_t cell, uint8_t side)
{
    bool mirrored = ((trial->cell ^ cell) & 1) != 0;
    bool generalized = is_of_one_side(trial->cell) && is_of_one_side(cell);

    if (trial->tick < 0.0 || trial->helped != 1)
        return false;
    if (trial->cell != cell && !generalized)
        return false;
    return side == (mirrored ? SIDE_LEFT + SIDE_RIGHT - trial->side : trial->side);
}

/* Whether the robot changed the cell itself: it learned from a trial that has just ended, or erased a turn. */
static bool did_itself(const struct history *history, int32_t cell, uint8_t side)
{
    return taught(&history->judged, cell, side) || (history->forgets && side == SIDE_NOTHING);
}

void history_learn(struct history *history, double tick, const uint8_t sides[CELL_COUNT])
{
    history->lesson_count = 0;
    for (int32_t cell = 0; cell < CELL_COUNT; cell++) {
        int32_t by_hand = !did_itself(history, cell, sides[cell]);

        if (sides[cell] == history->sides[cell])
            continue;
        history->sides[cell] = sides[cell];
        history->learned[cell] = tick;
        history->by_hand[cell] = by_hand;
        history->uses[cell] = history->used == cell;
        history->lessons[history->lesson_count++] =
            (struct history_lesson){cell, sides[cell], history->uses[cell], by_hand};
    }
}

void history_relearn(struct history *history, double tick, const uint8_t sides[CELL_COUNT])
{
    forget_doings(history);
    history_learn(history, tick, sides);
}
