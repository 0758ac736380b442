#include "host_sim/program/native/programmed.h"

#include <stddef.h>
#include <stdlib.h>

struct octet *programmed_open(uint8_t node, const uint8_t memory[CELL_COUNT], const char *text, size_t len)
{
    struct programmed *programmed = malloc(sizeof *programmed);

    if (!programmed)
        return NULL;
    octet_init(&programmed->octet, node, memory);
    programmed->octet.respond = programmed_robot_respond;
    programmed->octet.size = sizeof *programmed;
    (void)program_compile(&programmed->program, text, len);
    return &programmed->octet;   /* the first member: free() accepts its address */
}

const struct program *programmed_state(const struct octet *octet)
{
    return &((const struct programmed *)octet)->program;
}

/* Nothing to do: the caller reads programmed_state. */
void programmed_decided(const struct program *decided)
{
    (void)decided;
}

struct program *programmed_program(struct brain *brain)
{
    return &((struct programmed *)((char *)brain - offsetof(struct programmed, octet.robot.brain)))->program;
}
