#include "host_sim/program/native/programmed.h"

#include <stdio.h>
#include <string.h>

static void add(char told[PROGRAMMED_TOLD_MAX], const char *before, const char *text)
{
    size_t used = strlen(told);

    (void)snprintf(told + used, PROGRAMMED_TOLD_MAX - used, "%s%s", used > 0 ? before : "", text);
}

static void add_mistake(char told[PROGRAMMED_TOLD_MAX], const struct program_mistake *mistake)
{
    char text[PROGRAMMED_TOLD_MAX / 2];

    if (mistake->expected == EXPECTED_NOTHING)
        return;
    (void)snprintf(text, sizeof text, "line %u: %s%s%s: expected %s", (unsigned)mistake->line,
                   mistake->word[0] ? "\"" : "", mistake->word[0] ? mistake->word : "the line ends",
                   mistake->word[0] ? "\"" : "", program_expected(mistake->expected));
    add(told, "", text);
}

const char *programmed_printed(const struct program *program)
{
    return program->printed;
}

void programmed_tell(const struct program *program, char told[PROGRAMMED_TOLD_MAX])
{
    told[0] = '\0';
    add_mistake(told, &program->mistake);
    if (program->state == PROGRAM_ENDED)
        add(told, "; ", "it has ended");
    for (unsigned i = 0; i < PROGRAM_SHOWN_MAX && program->shown[i].text[0]; i++) {
        if (i == 0)
            add(told, "; ", "it shows");
        add(told, i > 0 ? " | " : " ", program->shown[i].text);
    }
}
