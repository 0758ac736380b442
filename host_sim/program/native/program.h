/* program.h: a robot's brain in the language of the article's listing. docs/article.md has the language.
 *
 * A program is compiled into instructions for a machine with a stack. The machine runs until the program gives the
 * robot an action, and continues from there when the action has ended: it never waits, and needs no thread. The
 * caller provides all memory. */
#ifndef OCTET_PROGRAM_H
#define OCTET_PROGRAM_H

#include <stddef.h>

#include "firmware/brain.h"

/* robot.toml has PROGRAM_TEXT_MAX, the bytes of a program, with a 0 after it. */
enum {
    PROGRAM_CODE_MAX = 4096,     /* instructions */
    PROGRAM_NUMBERS_MAX = 256,   /* different numeric literals */
    PROGRAM_NAMES_MAX = 192,     /* variables, arrays, labels and subs */
    PROGRAM_CELLS_MAX = 1024,    /* variables and cells of arrays */
    PROGRAM_STACK_MAX = 64,      /* values in use, and parameters */
    PROGRAM_CALLS_MAX = 32,      /* nested gosubs and calls */
    PROGRAM_ARGUMENTS_MAX = 8,   /* of a call */
    PROGRAM_STEPS_MAX = 200000,  /* instructions without an action; then it is an endless loop */
    PROGRAM_TRACE_MAX = 256,     /* steps of the last decision that are kept */
    PROGRAM_SHOWN_MAX = 16,      /* places of the screen with a text */
    PROGRAM_SHOWN_TEXT = 48,     /* bytes of such a text, with a 0 after it */
    PROGRAM_PRINTED_MAX = 4096,  /* bytes that are printed, with a 0 after them */
    PROGRAM_WORD_MAX = 32        /* bytes of a word in a mistake, with a 0 after it */
};

/* What was expected; program_expected gives the words. */
enum program_expected {
    EXPECTED_NOTHING, EXPECTED_STATEMENT, EXPECTED_VALUE, EXPECTED_LINE_END, EXPECTED_CLOSE, EXPECTED_BRACKET,
    EXPECTED_QUOTE, EXPECTED_EQUALS, EXPECTED_TO, EXPECTED_NAME, EXPECTED_COMMA, EXPECTED_ENDIF, EXPECTED_WEND,
    EXPECTED_NEXT, EXPECTED_IF, EXPECTED_WHILE, EXPECTED_FOR, EXPECTED_LABEL, EXPECTED_SUB, EXPECTED_GIVEN,
    EXPECTED_DIM, EXPECTED_NEW_NAME, EXPECTED_SIZE, EXPECTED_PLAIN, EXPECTED_SHORTER, EXPECTED_END, EXPECTED_INDEX,
    EXPECTED_SIDE, EXPECTED_ACTION, EXPECTED_RETURN, EXPECTED_GOSUB, EXPECTED_ARGUMENTS, EXPECTED_DIVISOR,
    EXPECTED_DEGREES, EXPECTED_WAY, EXPECTED_DELAY, EXPECTED_CHOICES, EXPECTED_AHEAD, EXPECTED_OPEN,
    EXPECTED_ONE_VALUE, EXPECTED_NO_VALUE, EXPECTED_PLACE, EXPECTED_UNTIL, EXPECTED_REPEAT, EXPECTED_LOOP,
    EXPECTED_NO_GOTO, EXPECTED_BRACKETS, EXPECTED_WRITTEN, EXPECTED_ANGLE, EXPECTED_NO_TEXT, EXPECTED_NO_DRAWING,
    EXPECTED_NO_KEYS, EXPECTED_NO_SENSOR, EXPECTED_NO_SETTING, EXPECTED_COUNT
};

struct program_mistake {
    uint16_t line;                  /* from 1 */
    uint8_t expected;               /* an enum program_expected; EXPECTED_NOTHING: there is no mistake */
    char word[PROGRAM_WORD_MAX];    /* what is there instead; empty at the end of a line */
};

struct instruction {
    uint8_t op;         /* an enum op of machine.h */
    uint8_t count;      /* of arguments */
    uint16_t operand;
};

enum name_kind { NAME_VARIABLE, NAME_ARRAY, NAME_LABEL, NAME_SUB };

struct program_name {
    uint16_t at, len;       /* in the text */
    uint16_t line;          /* where it is used first */
    uint16_t place;         /* its cell or its first cell; of a label or a sub, its instruction */
    uint16_t size;          /* cells */
    uint8_t kind;           /* an enum name_kind */
    uint8_t parameters;     /* of a sub, */
    uint8_t references;     /* and bit i for its i-th parameter if it is one by reference */
    bool given;             /* defined, or given a value somewhere */
};

struct program_value {
    double number;
    int16_t cell;           /* the variable that it comes from; -1: none */
};

struct program_call {
    uint16_t back;          /* the instruction after the call */
    uint8_t frame, stack;   /* the caller's first parameter and the height of its stack */
};

/* One step: at this line, and, unless cell is negative, with this value for a cell. */
struct program_step {
    uint16_t line;
    int16_t cell;
    double number;
};

struct program_shown {
    double x, y;
    char text[PROGRAM_SHOWN_TEXT];   /* empty: nothing is shown here */
};

enum program_state { PROGRAM_RUNS, PROGRAM_ENDED, PROGRAM_MISTAKEN };

struct program {
    char text[PROGRAM_TEXT_MAX];
    struct instruction code[PROGRAM_CODE_MAX];
    double numbers[PROGRAM_NUMBERS_MAX];
    struct program_name names[PROGRAM_NAMES_MAX];
    uint16_t code_count, number_count, name_count, cell_count;
    uint16_t memory;                       /* the first cell of Mem, */
    bool learns;                           /* if the program has it */
    bool measures;                         /* the program asks for distances */
    struct program_mistake mistake;

    /* program_begin resets everything from here on. */
    uint8_t state;                         /* an enum program_state */
    uint16_t at, line;                     /* the next instruction; the line under way */
    uint8_t stack_count, call_count, frame, shown_at;
    double cells[PROGRAM_CELLS_MAX];
    struct program_value stack[PROGRAM_STACK_MAX];
    struct program_call calls[PROGRAM_CALLS_MAX];
    struct program_shown shown[PROGRAM_SHOWN_MAX];
    bool written[PROGRAM_CELLS_MAX];       /* the cell has had a value */
    char printed[PROGRAM_PRINTED_MAX];     /* the first bytes of what PRINT has printed */
    uint16_t printed_len;
    struct program_step trace[PROGRAM_TRACE_MAX];
    uint16_t trace_count;
    double before[PROGRAM_CELLS_MAX];      /* the cells when the last decision began */
    int32_t way_left_mm, rest_left;        /* of the command under way: way still to go, ticks still to rest */
    double x_mm, y_mm;                     /* where the robot reckons it is, */
    int32_t heading_deg, turned_deg;       /* and where to, right of up; the turn under way */
    uint16_t odometer_left, odometer_right;
    bool felt;                             /* rFeel was asked since the last action */
    bool reckons;                          /* the odometers above are valid */
};

bool program_compile(struct program *program, const char *text, size_t len);
        /* Compiles a program, ready to begin. False: program->mistake says why, and the program does nothing. */

void program_begin(struct program *program);
        /* Starts from the top, with all variables 0. A program with a mistake does nothing. */

struct action program_next(struct program *program, struct brain *brain, const struct config *config,
                           const struct senses *senses);
        /* As brain_next. A program that has ended or stopped with an error rests. */

const char *program_expected(uint8_t expected);
        /* An enum program_expected in words. */

#endif
