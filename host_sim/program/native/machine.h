/* machine.h: what runs the instructions of a program. */
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
    bool acts;              /* the action above is what the robot is to do now */
};

void machine_fail(struct machine *machine, enum program_expected expected);
        /* The program makes a mistake in its line, and stops. */

void machine_push(struct machine *machine, double number, int cell);
double machine_pop(struct machine *machine);
        /* Values on the stack, with the cell that they come from, or -1. */

void machine_put(struct machine *machine, unsigned cell, double number);
        /* Gives a cell a value. What is put into Mem is what the robot has learned, unless its learning is frozen. */

void machine_take_memory(struct machine *machine);
        /* What the robot has learned is in Mem. */

void machine_clear(struct machine *machine, const struct program_name *array);
        /* All cells of an array are 0, but those of Mem. */

struct program_value *machine_parameter(struct machine *machine, unsigned number);
        /* A parameter of the sub that is running. */

bool machine_moves(struct machine *machine, const struct instruction *it);
        /* Executes an instruction that deals with values, variables and lines. False: it is another one. */

double machine_operate(struct machine *machine, enum operation operation, double a, double b);
        /* a operation b; an operation on one value has it for b. */

int32_t machine_whole(double number);
        /* The whole part, limited to 32 bits. */

void machine_function(struct machine *machine, enum function function, unsigned count);
void machine_command(struct machine *machine, enum deed deed, unsigned count);
        /* With this number of arguments on the stack. */

bool machine_continue(struct machine *machine);
        /* Goes on with a command that takes several actions. False: there is none. */

void machine_reckon(struct machine *machine);
        /* Takes in how far the wheels have rolled. */

void machine_show_at(struct machine *machine, double x, double y);
        /* Chooses a place, where nothing is shown any more. */

void machine_show_number(struct machine *machine, double number);
void machine_show_text(struct machine *machine, const char *text, size_t len);
        /* Adds to what is shown at the place that was chosen last. */

#endif
