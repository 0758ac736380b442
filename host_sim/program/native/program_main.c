/* The robot as a process, its brain a program: octet-program FILE, then the arguments of octet-robot. */
#include <stdio.h>
#include <string.h>

#include "host_sim/program/native/programmed.h"

int robot_main(int argc, char *argv[]);   /* firmware/main.c */

static struct program program;   /* static: the firmware's main passes nothing on; one robot per process */

static void tell(const char *what)
{
    char told[PROGRAMMED_TOLD_MAX];

    programmed_tell(&program, told);
    fprintf(stderr, "octet-program: %s: %s\n", what, told);
}

static int load(const char *path)
{
    static char text[PROGRAM_TEXT_MAX + 1];
    FILE *file = fopen(path, "rb");
    size_t len = file ? fread(text, 1, sizeof text, file) : 0;
    bool read = file && !ferror(file);

    if (file)
        (void)fclose(file);
    if (!read) {
        fprintf(stderr, "octet-program: cannot read %s\n", path);
        return -1;
    }
    if (program_compile(&program, text, len))
        return 0;
    tell(path);
    return -1;
}

struct program *programmed_program(struct brain *brain)
{
    (void)brain;
    return &program;
}

/* Prints what the program has printed since the last call, each line after "> ". */
static void hand_on(const char *printed)
{
    static size_t known;
    const char *end;

    known = known <= strlen(printed) ? known : 0;   /* the program has begun anew */
    end = strrchr(printed + known, '\n');
    for (const char *line = printed + known; end && line <= end; line = strchr(line, '\n') + 1)
        printf("> %.*s\n", (int)(strchr(line, '\n') - line), line);
    if (end) {
        known = (size_t)(end + 1 - printed);
        (void)fflush(stdout);
    }
}

/* Says once that it has stopped. */
void programmed_decided(const struct program *decided)
{
    static uint8_t known = PROGRAM_RUNS;

    hand_on(programmed_printed(decided));

    if (decided->state != known && decided->state != PROGRAM_RUNS)
        tell("the program");
    known = decided->state;
}

int main(int argc, char *argv[])
{
    if (argc < 2) {
        fprintf(stderr, "usage: octet-program FILE [octet-robot's arguments]\n");
        return 2;
    }
    return load(argv[1]) < 0 ? 2 : robot_main(argc - 1, argv + 1);
}
