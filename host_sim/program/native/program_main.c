/* The robot as a process, its brain a program: octet-program FILE, then the arguments of octet-robot. */
#include <stdio.h>

#include "host_sim/program/native/programmed.h"

int robot_main(int argc, char *argv[]);   /* firmware/main.c, which calls the other */
void program_respond(struct robot *robot, enum input_kind kind, const struct input *in, struct output *out);

static struct program program;   /* main of the firmware hands nothing on: there is one robot to a process */

struct program *programmed_program(struct brain *brain)
{
    (void)brain;
    return &program;
}

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

void program_respond(struct robot *robot, enum input_kind kind, const struct input *in, struct output *out)
{
    uint8_t before = program.state;

    programmed_robot_respond(robot, kind, in, out);
    if (program.state != before && program.state != PROGRAM_RUNS)
        tell("the program");
}

int main(int argc, char *argv[])
{
    if (argc < 2) {
        fprintf(stderr, "usage: octet-program FILE [octet-robot's arguments]\n");
        return 2;
    }
    return load(argv[1]) < 0 ? 2 : robot_main(argc - 1, argv + 1);
}
