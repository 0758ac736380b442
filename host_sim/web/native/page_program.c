#include "host_sim/web/native/page.h"

enum { STEP = 3, VARIABLE = 4 };   /* numbers per step, and per variable or array */

char *page_program_text(void)
{
    static char text[PROGRAM_TEXT_MAX];

    return text;
}

bool page_program(uint32_t robot, uint32_t len)
{
    static const uint8_t nothing[CELL_COUNT];
    struct octet *octet = programmed_open((uint8_t)(robot + 1), nothing, page_program_text(), len);

    if (!octet)
        return false;
    octet_close(page_octet(robot));
    page_bind(&page_state()->robots[robot], octet);
    return true;
}

static const struct program *program_of(uint32_t robot)
{
    return programmed_state(page_octet(robot));
}

static double *put_steps(double *at, const struct program *program)
{
    for (unsigned i = 0; i < program->trace_count; i++, at += STEP) {
        at[0] = program->trace[i].line;
        at[1] = program->trace[i].cell;
        at[2] = program->trace[i].number;
    }
    return at;
}

/* Returns their number. */
static unsigned put_variables(double *at, const struct program *program)
{
    unsigned count = 0;

    for (unsigned i = 0; i < program->name_count; i++) {
        const struct program_name *name = &program->names[i];

        if (name->kind != NAME_VARIABLE && name->kind != NAME_ARRAY)
            continue;
        at[VARIABLE * count] = name->place;
        at[VARIABLE * count + 1] = name->size;
        at[VARIABLE * count + 2] = name->at;
        at[VARIABLE * count + 3] = name->len;
        count++;
    }
    return count;
}

static unsigned shown_by(const struct program *program)
{
    unsigned count = 0;

    while (count < PROGRAM_SHOWN_MAX && program->shown[count].text[0] != '\0')
        count++;
    return count;
}

const double *page_program_state(uint32_t robot)
{
    static double numbers[PAGE_PROGRAM_NUMBERS + STEP * PROGRAM_TRACE_MAX + VARIABLE * PROGRAM_NAMES_MAX];
    const struct program *program = program_of(robot);

    numbers[PAGE_PROGRAM_ENDED] = program->state == PROGRAM_ENDED;
    numbers[PAGE_PROGRAM_LINE] = program->mistake.line;
    numbers[PAGE_PROGRAM_EXPECTED] = program->mistake.expected;
    numbers[PAGE_PROGRAM_CELLS] = program->cell_count;
    numbers[PAGE_PROGRAM_SHOWN] = shown_by(program);
    numbers[PAGE_PROGRAM_STEPS] = program->trace_count;
    numbers[PAGE_PROGRAM_VARIABLES] = put_variables(put_steps(numbers + PAGE_PROGRAM_NUMBERS, program), program);
    return numbers;
}

const double *page_program_cells(uint32_t robot)
{
    return program_of(robot)->before;
}

const char *page_program_word(uint32_t robot)
{
    return program_of(robot)->mistake.word;
}

const char *page_program_expected(uint32_t expected)
{
    return program_expected((uint8_t)expected);
}

const char *page_program_shown(uint32_t robot, uint32_t place)
{
    return program_of(robot)->shown[place].text;
}

const char *page_program_printed(uint32_t robot)
{
    return program_of(robot)->printed;
}
