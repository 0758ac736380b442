/* history.h: what a robot has learned in a run: its trials and their results, its lessons, and the use of each cell. */
#ifndef OCTET_HISTORY_H
#define OCTET_HISTORY_H

#include <stdbool.h>
#include <stdint.h>

#include "robot_words.h"

/* What counts of a tick. */
struct history_tick {
    int32_t feel;
    int32_t left_mm_s;
    int32_t right_mm_s;
    int32_t reason;
    int32_t action;
};

/* A random turn, tried because the pattern's cell was empty. */
struct history_trial {
    double tick;       /* in which it began; -1: there was none */
    int32_t cell;      /* the pattern */
    int32_t side;
    int32_t helped;    /* 1 if fewer front sensors were triggered afterwards, 0 if not; -1 during the turn */
    int32_t frozen;    /* 1 if learning was frozen when it ended */
};

/* A change of a cell. */
struct history_lesson {
    int32_t cell;
    int32_t side;
    int32_t by_hand;   /* 1 if it came from outside, 0 if the robot learned or forgot it */
};

struct history {
    uint8_t sides[CELL_COUNT];     /* the turn for each pattern */
    bool frozen;                   /* the caller sets it */
    int32_t action;                /* the current one; -1 before the first */
    int32_t reason;
    int32_t pattern;               /* of the front sensors when it was decided */
    int32_t trials;                /* so far */
    int32_t uses[CELL_COUNT];      /* remembered turns that used a cell's present content */
    int32_t by_hand[CELL_COUNT];   /* of a cell's last change */
    double learned[CELL_COUNT];    /* the tick of that change; -1: none */
    struct history_trial trial;    /* the last one */
    uint32_t lesson_count;         /* lessons of the last call */
    struct history_lesson lessons[CELL_COUNT];
};

void history_begin(struct history *history, const uint8_t sides[CELL_COUNT]);
        /* Nothing has been learned yet. sides are the turns that the robot knows. */

void history_take(struct history *history, double tick, const struct history_tick *what, const uint8_t sides[CELL_COUNT]);
        /* Adds a tick, with the turns that the robot knows after it. */

void history_pass_over(struct history *history, const struct history_tick *last, int32_t pattern);
        /* Skips ticks in which no remembered turn and no trial began or ended, and the memory stayed the same: the last of
           them, and the pattern when its action was decided. */

void history_relearn(struct history *history, double tick, const uint8_t sides[CELL_COUNT]);
        /* The robot knows these turns now; it was told those that are new. */

void history_restart(struct history *history, const uint8_t sides[CELL_COUNT]);
        /* The robot has been started again, and knows these turns. */

#endif
