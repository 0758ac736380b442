/* code.h: the instructions of a program, and the names built into the language. */
#ifndef OCTET_PROGRAM_CODE_H
#define OCTET_PROGRAM_CODE_H

#include "host_sim/program/native/program.h"

/* The operand is an index of a number, name or instruction, a line, a parameter, or one of the enums below. A cell of
 * an array takes its index from the stack. */
enum op {
    OP_LINE, OP_NUMBER, OP_LOAD, OP_LOAD_CELL, OP_LOAD_PARAMETER, OP_STORE, OP_STORE_CELL, OP_STORE_PARAMETER,
    OP_UNARY, OP_BINARY, OP_FUNCTION, OP_COMMAND, OP_SHOW_NUMBER, OP_SHOW_TEXT, OP_JUMP, OP_JUMP_IF_NOT, OP_FOR,
    OP_GOSUB, OP_CALL, OP_RETURN, OP_DIM, OP_FALL, OP_END
};

enum operation {
    DO_OR, DO_AND, DO_EQUAL, DO_UNEQUAL, DO_LESS, DO_LESS_EQUAL, DO_GREATER, DO_GREATER_EQUAL, DO_BIT_OR, DO_BIT_AND,
    DO_SHIFT_LEFT, DO_SHIFT_RIGHT, DO_ADD, DO_SUBTRACT, DO_MULTIPLY, DO_DIVIDE, DO_MODULO, DO_NEGATE, DO_NOT
};

enum function {
    DO_RANDOM, DO_FEEL, DO_LOOK, DO_BEACON, DO_GPS_X, DO_GPS_Y, DO_COMPASS, DO_BUMPER, DO_ABS, DO_INT
};

enum deed { DO_FORWARD, DO_TURN, DO_DELAY, DO_LOCATE, DO_EAT, DO_SHOW };

/* A function or a command. */
struct known_word {
    const char *name;      /* in lower case */
    uint8_t least, most;   /* arguments */
};

extern const struct known_word CODE_FUNCTIONS[], CODE_COMMANDS[];
extern const unsigned CODE_FUNCTION_COUNT, CODE_COMMAND_COUNT;

enum { COLOUR_GREEN = 2, COLOUR_WHITE = 15 };

bool code_constant(const char *word, size_t len, double *value);
        /* The value of a named constant, such as Green. False: the word is not one. */

bool code_same(const char *word, size_t len, const char *name);
        /* Whether a word is this name, ignoring case. */

int code_find(const struct known_word words[], unsigned count, const char *word, size_t len);
        /* The index of a word among known ones; -1: not found. */

#endif
