/* program: whatever text comes as a program, and whatever its robot senses while it runs. */
#include "host_sim/program/native/program.h"

#include <string.h>

#include "tests/proof/any/any.h"

enum { DECISIONS_MAX = 40, WORDS = 128, DEGREES_MAX = 720, WAY_MAX_MM = 150 };

/* A byte from 128 on is one of these, so that much of what comes is a program. */
static const char *const words[] = {
    "if ", "then ", "elseif ", "else ", "endif\n", "while ", "wend\n", "for i = ", " to ", " step ", "next\n", "gosub A\n",
    "gosub B\n", "return\n", "call S(", "sub S(x,&y)\n", "sub T(&x)\n", "call T(", "end\n", "A:\n", "B:\n", "dim a[7]\n", "a[", "Mem[",
    "random(", "rFeel()", "rLook(0)", "rBeacon(Green)", "rGPSx()", "rCompass()", "rForward ", "rTurn ", "delay ", "rLocate ",
    "rEat\n", "xyString ", "\"text\"", "x", "y", "i", "x=", "y=", "x++\n", "y--\n", "1", "2", "8", "700", "2.5", " and ", " not ",
    ">>", "<=", "\n", "\n", "\\", "]=", ")", "// x\n", "abs(", "int(", " mod ", "\xe2\x80\x9d", "\xe2\x88\x92",
};

static size_t any_text(char text[], size_t most)
{
    unsigned count = any_u8() * 4u;
    size_t used = 0;

    for (unsigned i = 0; i < count && any_more(); i++) {
        uint8_t byte = any_u8();
        const char letter[] = {(char)byte, '\0'};
        const char *word = byte < WORDS ? letter : words[(byte - WORDS) % (sizeof words / sizeof *words)];
        size_t len = byte < WORDS ? 1 : strlen(word);

        if (used + len > most)
            break;
        memcpy(text + used, word, len);
        used += len;
    }
    return used;
}

static struct senses any_senses(void)
{
    return (struct senses){
        .feel = any_between(0, 31), .bump = any_bool(), .look = any_bool(), .beacon_mm = any_u16(),
        .odometer_left = any_u16() % ODOMETER_SPAN, .odometer_right = any_u16() % ODOMETER_SPAN,
    };
}

static void check(const struct program *program, const struct brain *brain, const struct action *action)
{
    must(action->turn_deg >= -DEGREES_MAX && action->turn_deg <= DEGREES_MAX);
    must(action->forward_mm >= -WAY_MAX_MM && action->forward_mm <= WAY_MAX_MM);
    must(program->stack_count <= PROGRAM_STACK_MAX && program->call_count <= PROGRAM_CALLS_MAX);
    must(brain->memory.cell[0] == 0);
    for (unsigned p = 1; p < CELL_COUNT; p++)
        must(brain->memory.cell[p] <= SIDE_RIGHT);
    must((program->state == PROGRAM_MISTAKEN) == (program->mistake.expected != EXPECTED_NOTHING));
    must(program->mistake.line <= PROGRAM_TEXT_MAX && memchr(program->mistake.word, 0, PROGRAM_WORD_MAX));
}

void exercise(void)
{
    static struct program program;
    static char text[PROGRAM_TEXT_MAX + 8];
    struct brain brain = {.frozen = any_bool()};
    struct config config;
    size_t len = any_text(text, sizeof text);

    config_reset(&config);
    (void)brain_start(&brain, PROFILE_ARTICLE, any_u8());
    (void)program_compile(&program, text, len);
    for (unsigned i = 0; i < DECISIONS_MAX; i++) {
        struct senses senses = any_senses();
        struct action action = program_next(&program, &brain, &config, &senses);

        check(&program, &brain, &action);
    }
}
