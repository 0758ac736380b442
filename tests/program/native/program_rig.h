/* program_rig.h: a program, and the senses of its robot. */
#ifndef OCTET_PROGRAM_RIG_H
#define OCTET_PROGRAM_RIG_H

#include <string.h>

#include "tests/test.h"
#include "host_sim/program/native/program.h"

static struct program program;
static struct brain brain;
static struct config config;
static struct senses senses;

/* A robot at its start, without any sensor triggered. */
static inline void rig_reset(void)
{
    config_reset(&config);
    brain = (struct brain){.frozen = false};
    (void)brain_start(&brain, PROFILE_ARTICLE, 1);
    senses = (struct senses){.tick = 0};
}

/* Returns the action after that. */
static inline struct action rig_next(void)
{
    return program_next(&program, &brain, &config, &senses);
}

/* Compiles a program, which must have no mistake, and returns its first action. */
static inline struct action rig_begin(const char *text)
{
    if (!program_compile(&program, text, strlen(text)))
        TEST_FAIL_MESSAGE(program.mistake.word);
    return rig_next();
}

/* The value of a variable. */
static inline double rig_value(const char *name)
{
    for (unsigned i = 0; i < program.name_count; i++)
        if (program.names[i].len == strlen(name) && strncmp(program.text + program.names[i].at, name, strlen(name)) == 0)
            return program.cells[program.names[i].place];
    TEST_FAIL_MESSAGE(name);
    return 0;
}

/* Checks that compiling or running a program fails with this mistake. */
static inline void rig_fails(const char *text, unsigned line, const char *word, enum program_expected expected)
{
    if (program_compile(&program, text, strlen(text)))
        (void)rig_next();
    TEST_ASSERT_EQUAL_STRING_MESSAGE(program_expected((uint8_t)expected), program_expected(program.mistake.expected), text);
    TEST_ASSERT_EQUAL_MESSAGE(line, program.mistake.line, text);
    TEST_ASSERT_EQUAL_STRING_MESSAGE(word, program.mistake.word, text);
    TEST_ASSERT_EQUAL_MESSAGE(PROGRAM_MISTAKEN, program.state, text);
}

#endif
