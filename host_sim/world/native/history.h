/* history.h: a robot's learning in a run: trials and their results, lessons, and the use of each cell. */
#ifndef OCTET_HISTORY_H
#define OCTET_HISTORY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "robot_words.h"

/* A random turn, tried because the pattern's cell was empty. */
struct history_trial {
    double tick;       /* in which it began; -1: there was none */
    int32_t cell;      /* the pattern */
    int32_t side;
    int32_t helped;    /* 1 if fewer front sensors were triggered afterwards, 0 if not; -1 during the turn */
    int32_t frozen;    /* 1 if learning was frozen when it ended */
};

/* A turn or a trial that began, or a trial that ended. */
struct history_note {
    double tick;
    int32_t reason;    /* of the action that began */
    int32_t cell;      /* the pattern when it was decided; its cell then: */
    int32_t uses;
    int32_t by_hand;
    double learned;
    struct history_trial trial;   /* the last one, after it */
};

/* A change of a cell. */
struct history_lesson {
    int32_t cell;
    int32_t side;
    int32_t uses;      /* of its new content: 1 if it was used when it changed */
    int32_t by_hand;   /* 1 if it came from outside, 0 if the robot learned or forgot it */
};

struct history {
    uint8_t sides[CELL_COUNT];     /* the turn for each pattern */
    bool frozen;                   /* the caller sets it */
    int32_t action;                /* the current one; -1 before the first */
    int32_t reason;
    int32_t pattern;               /* of the front sensors when it was decided */
    int32_t trials;                /* so far */
    int32_t used;                  /* cell of the remembered turn that began in the last tick; -1: none did */
    struct history_trial judged;   /* the trial that ended in the last tick; tick is -1 if none did */
    bool forgets;                  /* the robot itself may have erased a cell in the last tick */
    int32_t uses[CELL_COUNT];      /* remembered turns that used a cell's present content */
    int32_t by_hand[CELL_COUNT];   /* of a cell's last change */
    double learned[CELL_COUNT];    /* the tick of that change; -1: none */
    struct history_trial trial;    /* the last one */
    uint32_t lesson_count;         /* lessons of the last history_learn or history_relearn */
    struct history_lesson lessons[CELL_COUNT];
};

void history_begin(struct history *history, const uint8_t sides[CELL_COUNT]);
        /* Begins without trials and lessons. sides are the turns that the robot knows. */

size_t history_take(struct history *history, double tick, int16_t *rows, size_t ticks, struct history_note *notes);
        /* Adds ticks, from this one on: a row each, ROW_COUNT numbers, in which pattern and frozen are filled in.
           Returns the number of notes; there must be room for one for each tick. */

void history_learn(struct history *history, double tick, const uint8_t sides[CELL_COUNT]);
        /* Compares the turns known after that tick, the last one taken: changes that the tick explains were learned
           or forgotten by the robot, all others were made from outside. */

void history_relearn(struct history *history, double tick, const uint8_t sides[CELL_COUNT]);
        /* Sets the turns known before that tick; new ones were made from outside. */

void history_restart(struct history *history, const uint8_t sides[CELL_COUNT]);
        /* Restarts with these turns, as the robot was started again. */

#endif
