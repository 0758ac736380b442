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

void machine_fail_unwritten(struct machine *machine, unsigned cell)
{
    struct program *program = machine->program;

    if (program->state != PROGRAM_RUNS)
        return;
    machine_fail(machine, EXPECTED_WRITTEN);
    for (unsigned i = 0; i < program->name_count; i++) {
        const struct program_name *name = &program->names[i];

        if (name->kind == NAME_VARIABLE && name->place == cell) {
            memcpy(program->mistake.word, program->text + name->at, name->len);
            program->mistake.word[name->len] = '\0';
        }
    }
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

enum { SHIFT_MAX = 31 };

int32_t machine_whole(double number)
{
    if (number >= INT32_MAX)
        return INT32_MAX;
    return number > INT32_MIN ? (int32_t)number : number <= INT32_MIN ? INT32_MIN : 0;   /* NaN becomes 0 */
}

static uint32_t bits(double number)
{
    return (uint32_t)machine_whole(number);
}

static unsigned places(double number)
{
    int32_t whole = machine_whole(number);

    return whole < 0 ? 0u : whole > SHIFT_MAX ? (unsigned)SHIFT_MAX : (unsigned)whole;
}

static double compared(enum operation operation, double a, double b)
{
    switch (operation) {
    case DO_OR:
        return a != 0 || b != 0;
    case DO_AND:
        return a != 0 && b != 0;
    case DO_EQUAL:
        return a == b;
    case DO_UNEQUAL:
        return a != b;
    case DO_LESS:
        return a < b;
    case DO_LESS_EQUAL:
        return a <= b;
    case DO_GREATER:
        return a > b;
    default:
        return a >= b;
    }
}

static double of_bits(enum operation operation, double a, double b)
{
    switch (operation) {
    case DO_BIT_OR:
        return (int32_t)(bits(a) | bits(b));
    case DO_BIT_AND:
        return (int32_t)(bits(a) & bits(b));
    case DO_SHIFT_LEFT:
        return (int32_t)(bits(a) << places(b));
    default:
        return (int32_t)(bits(a) >> places(b));
    }
}

static double divided(struct machine *machine, enum operation operation, double a, double b)
{
    int64_t divisor = machine_whole(b);

    if (operation == DO_DIVIDE ? b == 0 : divisor == 0) {
        machine_fail(machine, EXPECTED_DIVISOR);
        return 0;
    }
    return operation == DO_DIVIDE ? a / b : (double)(machine_whole(a) % divisor);
}

double machine_operate(struct machine *machine, enum operation operation, double a, double b)
{
    if (operation <= DO_GREATER_EQUAL)
        return compared(operation, a, b);
    if (operation <= DO_SHIFT_RIGHT)
        return of_bits(operation, a, b);
    switch (operation) {
    case DO_ADD:
        return a + b;
    case DO_SUBTRACT:
        return a - b;
    case DO_MULTIPLY:
        return a * b;
    case DO_NEGATE:
        return -b;
    case DO_NOT:
        return b == 0;
    default:
        return divided(machine, operation, a, b);
    }
}
