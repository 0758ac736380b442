#include "host_sim/program/native/machine.h"

#include <string.h>

/* The first word of the line under way. */
static void quote_line(const struct program *program, struct program_mistake *mistake)
{
    const char *at = program->text;
    size_t len;

    for (unsigned line = 1; line < mistake->line && strchr(at, '\n'); line++)
        at = strchr(at, '\n') + 1;
    at += strspn(at, " \t");
    len = strcspn(at, " \t\r\n(=/\\");
    len = len < PROGRAM_WORD_MAX ? len : PROGRAM_WORD_MAX - 1;
    memcpy(mistake->word, at, len);
    mistake->word[len] = '\0';
}

void machine_fail(struct machine *machine, enum program_expected expected)
{
    struct program *program = machine->program;

    if (program->state != PROGRAM_RUNS)
        return;
    program->state = PROGRAM_MISTAKEN;
    program->mistake = (struct program_mistake){.line = program->line, .expected = (uint8_t)expected};
    quote_line(program, &program->mistake);
}

void machine_push(struct machine *machine, double number, int cell)
{
    struct program *program = machine->program;

    if (program->stack_count == PROGRAM_STACK_MAX)
        machine_fail(machine, EXPECTED_PLAIN);
    else
        program->stack[program->stack_count++] = (struct program_value){number, (int16_t)cell};
}

/* Compiled code never pops more than it has pushed, unless the stack was full. */
double machine_pop(struct machine *machine)
{
    struct program *program = machine->program;

    return program->stack_count > program->frame ? program->stack[--program->stack_count].number : 0;
}
