#include "tests/program/native/program_rig.h"

#include <string.h>

#include "tests/test.h"

struct program program;
struct brain brain;
struct config config;
struct senses senses;

void rig_reset(void)
{
    config_reset(&config);
    brain = (struct brain){.frozen = false};
    (void)brain_start(&brain, PROFILE_ARTICLE, 1);
    senses = (struct senses){.tick = 0};
}

struct action rig_next(void)
{
    return program_next(&program, &brain, &config, &senses);
}

struct action rig_begin(const char *text)
{
    if (!program_compile(&program, text, strlen(text)))
        TEST_FAIL_MESSAGE(program.mistake.word);
    return rig_next();
}

double rig_value(const char *name)
{
    for (unsigned i = 0; i < program.name_count; i++)
        if (program.names[i].len == strlen(name) && strncmp(program.text + program.names[i].at, name, strlen(name)) == 0)
            return program.cells[program.names[i].place];
    TEST_FAIL_MESSAGE(name);
    return 0;
}

void rig_fails(const char *text, unsigned line, const char *word, enum program_expected expected)
{
    if (program_compile(&program, text, strlen(text)))
        (void)rig_next();
    TEST_ASSERT_EQUAL_STRING_MESSAGE(program_expected((uint8_t)expected), program_expected(program.mistake.expected), text);
    TEST_ASSERT_EQUAL_MESSAGE(line, program.mistake.line, text);
    TEST_ASSERT_EQUAL_STRING_MESSAGE(word, program.mistake.word, text);
    TEST_ASSERT_EQUAL_MESSAGE(PROGRAM_MISTAKEN, program.state, text);
}
