/* machine.h: the virtual machine that runs a program. */
#ifndef OCTET_PROGRAM_MACHINE_H
#define OCTET_PROGRAM_MACHINE_H

#include "host_sim/program/native/code.h"

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

void machine_show_at(struct machine *machine, double x, double y);
        /* Selects a place of the screen and clears it. */

void machine_show_number(struct machine *machine, double number);
void machine_show_text(struct machine *machine, const char *text, size_t len);
        /* Appends to the text at the selected place. */

#endif
