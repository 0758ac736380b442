#include "host_sim/program/native/machine.h"

enum { NO_CELL = -1 };

static void step(struct program *program, int cell, double number)
{
    if (program->trace_count < PROGRAM_TRACE_MAX)
        program->trace[program->trace_count++] = (struct program_step){program->line, (int16_t)cell, number};
}

static void give(struct program *program, unsigned cell, double number)
{
    program->cells[cell] = number;
    program->written[cell] = true;
}

static void learn(struct machine *machine, unsigned cell, double number)
{
    unsigned pattern = cell - machine->program->memory;

    if (number != 0 && (pattern == 0 || (number != SIDE_LEFT && number != SIDE_RIGHT))) {
        machine_fail(machine, EXPECTED_SIDE);
        return;
    }
    if (machine->brain->frozen || machine->brain->memory.cell[pattern] == (uint8_t)number)
        return;
    machine->brain->memory.cell[pattern] = (uint8_t)number;
    machine->brain->changed = true;
}

void machine_put(struct machine *machine, unsigned cell, double number)
{
    struct program *program = machine->program;
    bool remembered = program->learns && cell >= program->memory && cell < (unsigned)program->memory + CELL_COUNT;

    if (remembered)
        learn(machine, cell, number);
    if (remembered && machine->brain->frozen)
        return;
    give(program, cell, number);
    step(program, (int)cell, number);
}

void machine_take_memory(struct machine *machine)
{
    struct program *program = machine->program;

    for (unsigned p = 0; program->learns && p < CELL_COUNT; p++)
        give(program, program->memory + p, machine->brain->memory.cell[p]);
}

/* The cell of an array that the index on the stack selects; negative if there is no such cell. */
static int cell_of(struct machine *machine, uint16_t name)
{
    const struct program_name *array = &machine->program->names[name];
    double index = machine_pop(machine);

    if (index >= 0 && index < array->size)
        return array->place + machine_whole(index);
    machine_fail(machine, EXPECTED_INDEX);
    return NO_CELL;
}

static void load(struct machine *machine, int cell)
{
    if (cell >= 0 && !machine->program->written[cell])
        machine_fail_unwritten(machine, (unsigned)cell);
    else if (cell >= 0)
        machine_push(machine, machine->program->cells[cell], cell);
}

struct program_value *machine_parameter(struct machine *machine, unsigned number)
{
    return &machine->program->stack[machine->program->frame + number];
}

static void load_parameter(struct machine *machine, const struct program_value *from)
{
    if (from->cell >= 0)
        load(machine, from->cell);
    else
        machine_push(machine, from->number, NO_CELL);
}

static void store_parameter(struct machine *machine, struct program_value *to)
{
    double number = machine_pop(machine);

    if (to->cell >= 0)
        machine_put(machine, (unsigned)to->cell, number);
    else
        to->number = number;
}

static void store_cell(struct machine *machine, uint16_t name)
{
    double number = machine_pop(machine);
    int cell = cell_of(machine, name);

    if (cell >= 0)
        machine_put(machine, (unsigned)cell, number);
}

void machine_clear(struct machine *machine, const struct program_name *array)
{
    for (unsigned i = 0; i < array->size; i++)
        if (!machine->program->learns || array->place != machine->program->memory)
            give(machine->program, array->place + i, 0);
}

static void begin_line(struct program *program, uint16_t line)
{
    program->line = line;
    step(program, NO_CELL, 0);
}

/* Executes instructions of values and variables. Returns false for any other instruction. */
bool machine_moves(struct machine *machine, const struct instruction *it)
{
    struct program *program = machine->program;

    switch (it->op) {
    case OP_LINE:
        begin_line(program, it->operand);
        return true;
    case OP_NUMBER:
        machine_push(machine, program->numbers[it->operand], NO_CELL);
        return true;
    case OP_LOAD:
        load(machine, it->operand);
        return true;
    case OP_LOAD_CELL:
        load(machine, cell_of(machine, it->operand));
        return true;
    case OP_LOAD_PARAMETER:
        load_parameter(machine, machine_parameter(machine, it->operand));
        return true;
    case OP_STORE:
        machine_put(machine, it->operand, machine_pop(machine));
        return true;
    case OP_STORE_CELL:
        store_cell(machine, it->operand);
        return true;
    case OP_STORE_PARAMETER:
        store_parameter(machine, machine_parameter(machine, it->operand));
        return true;
    default:
        return false;
    }
}
