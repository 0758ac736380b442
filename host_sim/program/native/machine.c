#include "host_sim/program/native/machine.h"

#include <stddef.h>
#include <string.h>

enum { NO_CELL = -1, REST_TICKS = 250 };

static void binary(struct machine *machine, enum operation operation)
{
    double b = machine_pop(machine);
    double a = operation < DO_NEGATE ? machine_pop(machine) : 0;

    machine_push(machine, machine_operate(machine, operation, a, b), NO_CELL);
}

/* Twice the value on top. */
static void copy(struct machine *machine)
{
    double value = machine_pop(machine);

    machine_push(machine, value, NO_CELL);
    machine_push(machine, value, NO_CELL);
}

static void loop_on(struct machine *machine)
{
    double by = machine_pop(machine), limit = machine_pop(machine), at = machine_pop(machine);

    machine_push(machine, by >= 0 ? at <= limit : at >= limit, NO_CELL);
}

/* Calls a sub with its arguments, or a label. Only a parameter by reference keeps its variable's cell. */
static void call(struct machine *machine, const struct instruction *it)
{
    struct program *program = machine->program;
    const struct program_name *name = &program->names[it->operand];
    uint8_t base = (uint8_t)(program->stack_count - it->count);

    if (program->call_count == PROGRAM_CALLS_MAX) {
        machine_fail(machine, EXPECTED_RETURN);
        return;
    }
    program->calls[program->call_count++] = (struct program_call){program->at, program->frame, base};
    if (it->op == OP_CALL)
        program->frame = base;
    for (unsigned i = 0; it->op == OP_CALL && i < it->count; i++)
        if (!(name->references & 1u << i))
            machine_parameter(machine, i)->cell = NO_CELL;
    program->at = name->place;
}

static void go_back(struct machine *machine)
{
    struct program *program = machine->program;
    struct program_call *from;

    if (program->call_count == 0) {
        machine_fail(machine, EXPECTED_GOSUB);
        return;
    }
    from = &program->calls[--program->call_count];
    program->at = from->back;
    program->frame = from->frame;
    program->stack_count = from->stack;
}

/* Executes jumps, calls and returns. Returns false for any other instruction. */
static bool leads(struct machine *machine, const struct instruction *it)
{
    struct program *program = machine->program;

    switch (it->op) {
    case OP_JUMP:
        program->at = it->operand;
        return true;
    case OP_JUMP_IF_NOT:
        program->at = machine_pop(machine) != 0 ? program->at : it->operand;
        return true;
    case OP_FOR:
        loop_on(machine);
        return true;
    case OP_GOTO:
        program->at = program->names[it->operand].place;
        return true;
    case OP_GOSUB:
    case OP_CALL:
        call(machine, it);
        return true;
    case OP_RETURN:
        go_back(machine);
        return true;
    case OP_FALL:
        machine_fail(machine, EXPECTED_END);
        return true;
    case OP_END:
        program->state = PROGRAM_ENDED;
        return true;
    default:
        return false;
    }
}

/* Executes what shows or prints. Returns false for any other instruction. */
static bool tells(struct machine *machine, const struct instruction *it)
{
    const char *text = machine->program->text + it->operand;
    char character = (char)it->operand;

    switch (it->op) {
    case OP_SHOW_NUMBER:
        machine_show_number(machine, machine_pop(machine));
        return true;
    case OP_SHOW_TEXT:
        machine_show_text(machine, text, it->count);
        return true;
    case OP_PRINT_NUMBER:
        machine_print_number(machine, machine_pop(machine));
        return true;
    case OP_PRINT_TEXT:
        machine_print_text(machine, text, it->count);
        return true;
    case OP_PRINT_CHARACTER:
        machine_print_text(machine, &character, 1);
        return true;
    default:
        return false;
    }
}

static void execute(struct machine *machine, const struct instruction *it)
{
    if (machine_moves(machine, it) || leads(machine, it) || tells(machine, it))
        return;
    if (it->op == OP_FUNCTION)
        machine_function(machine, (enum function)it->operand, it->count);
    else if (it->op == OP_COMMAND)
        machine_command(machine, (enum deed)it->operand, it->count);
    else if (it->op == OP_COPY)
        copy(machine);
    else if (it->op == OP_DIM)
        machine_clear(machine, &machine->program->names[it->operand]);
    else
        binary(machine, (enum operation)it->operand);
}

static void run(struct machine *machine)
{
    struct program *program = machine->program;

    for (unsigned steps = 0; program->state == PROGRAM_RUNS && !machine->acts; steps++) {
        if (steps == PROGRAM_STEPS_MAX)
            machine_fail(machine, EXPECTED_ACTION);
        else
            execute(machine, &program->code[program->at++]);
    }
}

struct action program_next(struct program *program, struct brain *brain, const struct config *config,
                           const struct senses *senses)
{
    struct machine machine = {.program = program, .brain = brain, .config = config, .senses = senses};

    machine_take_memory(&machine);
    machine_reckon(&machine);
    if (!machine_continue(&machine)) {
        program->trace_count = 0;
        memcpy(program->before, program->cells, sizeof program->before);
        run(&machine);
    }
    if (!machine.acts)
        machine.action = (struct action){.reason = REASON_PROGRAM, .rest_ticks = REST_TICKS};
    return machine.action;
}

/* What program_compile leaves without code never runs. */
void program_begin(struct program *program)
{
    size_t first = offsetof(struct program, state);

    memset((char *)program + first, 0, sizeof *program - first);
    program->state = program->code_count > 0 ? PROGRAM_RUNS : PROGRAM_MISTAKEN;
    if (program->code_count > 0)
        program->mistake = (struct program_mistake){.expected = EXPECTED_NOTHING};
}
