/* machine.h: the virtual machine that runs a program. */
#ifndef OCTET_MACHINE_H
#define OCTET_MACHINE_H

#include "host_sim/program/native/program.h"

/* The instructions of a program, and the names built into the language. */

/* The operand is an index of a number, name or instruction, a line, a parameter, or one of the enums below. A cell of
 * an array takes its index from the stack. */
enum op {
    OP_LINE, OP_NUMBER, OP_LOAD, OP_LOAD_CELL, OP_LOAD_PARAMETER, OP_STORE, OP_STORE_CELL, OP_STORE_PARAMETER,
    OP_UNARY, OP_BINARY, OP_FUNCTION, OP_COMMAND, OP_SHOW_NUMBER, OP_SHOW_TEXT, OP_PRINT_NUMBER, OP_PRINT_TEXT,
    OP_PRINT_CHARACTER, OP_COPY, OP_JUMP, OP_JUMP_IF_NOT, OP_FOR, OP_GOTO, OP_GOSUB, OP_CALL, OP_RETURN, OP_DIM,
    OP_FALL, OP_END
};

enum operation {
    DO_OR, DO_AND, DO_EQUAL, DO_UNEQUAL, DO_LESS, DO_LESS_EQUAL, DO_GREATER, DO_GREATER_EQUAL, DO_BIT_OR, DO_BIT_AND,
    DO_SHIFT_LEFT, DO_SHIFT_RIGHT, DO_ADD, DO_SUBTRACT, DO_MULTIPLY, DO_DIVIDE, DO_MODULO, DO_NEGATE, DO_NOT
};

enum function {
    DO_RANDOM, DO_FEEL, DO_LOOK, DO_BEACON, DO_GPS_X, DO_GPS_Y, DO_COMPASS, DO_BUMPER, DO_RANGE, DO_ABS, DO_INT
};

enum deed { DO_FORWARD, DO_TURN, DO_DELAY, DO_LOCATE, DO_EAT, DO_SHOW };

/* A function or a command. */
struct known_word {
    const char *name;      /* in lower case */
    uint8_t least, most;   /* arguments */
};

extern const struct known_word CODE_FUNCTIONS[], CODE_COMMANDS[];
extern const unsigned CODE_FUNCTION_COUNT, CODE_COMMAND_COUNT;

/* A word of RobotBASIC that this language lacks. */
struct foreign_word {
    const char *name;      /* in lower case */
    enum program_expected instead;
};

extern const struct foreign_word CODE_FOREIGN[];
extern const unsigned CODE_FOREIGN_COUNT;

enum { COLOUR_GREEN = 2, COLOUR_WHITE = 15 };

bool code_constant(const char *word, size_t len, double *value);
        /* The value of a named constant, such as Green. False: the word is not one. */

bool code_same(const char *word, size_t len, const char *name);
        /* Whether a word is this name, ignoring case. */

int code_find(const struct known_word words[], unsigned count, const char *word, size_t len);
        /* The index of a word among known ones; -1: not found. */

/* A program at work on one decision. */
struct machine {
    struct program *program;
    struct brain *brain;
    const struct config *config;
    const struct senses *senses;
    struct action action;
    bool acts;              /* the action above is to be carried out now */
};

void machine_fail(struct machine *machine, enum program_expected expected);
        /* Stops the program with a run-time error in its line. */

void machine_fail_unwritten(struct machine *machine, unsigned cell);
        /* The same, for a variable that is read before it has a value. */

void machine_push(struct machine *machine, double number, int cell);
double machine_pop(struct machine *machine);
        /* Push and pop values on the stack, with the cell that they come from, or -1. */

void machine_put(struct machine *machine, unsigned cell, double number);
        /* Sets a cell. One of Mem is set in the robot's memory, too; while learning is frozen, neither is. */

void machine_take_memory(struct machine *machine);
        /* Copies the robot's memory to Mem. */

void machine_clear(struct machine *machine, const struct program_name *array);
        /* Clears an array, except Mem. */

struct program_value *machine_parameter(struct machine *machine, unsigned number);
        /* A parameter of the current sub. */

bool machine_moves(struct machine *machine, const struct instruction *it);
        /* Executes an instruction on values, variables or lines. False: it is another kind. */

double machine_operate(struct machine *machine, enum operation operation, double a, double b);
        /* a operation b; a unary operation takes b. */

int32_t machine_whole(double number);
        /* The whole part, limited to 32 bits. */

void machine_function(struct machine *machine, enum function function, unsigned count);
void machine_command(struct machine *machine, enum deed deed, unsigned count);
        /* With this number of arguments on the stack. */

bool machine_continue(struct machine *machine);
        /* Continues a command that takes several actions. False: there is none. */

void machine_reckon(struct machine *machine);
        /* Updates the reckoning from the odometers. */

void machine_print_number(struct machine *machine, double number);
void machine_print_text(struct machine *machine, const char *text, size_t len);
        /* Print; text for which there is no room is lost. */

void machine_show_at(struct machine *machine, double x, double y);
        /* Selects a place of the screen and clears it. */

void machine_show_number(struct machine *machine, double number);
void machine_show_text(struct machine *machine, const char *text, size_t len);
        /* Appends to the text at the selected place. */

#endif
