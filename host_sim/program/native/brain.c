/* brain.c: the robot's two questions to its brain, answered by a program. robot.c, commands.c and caution.c ask them
 * under these names, where they are compiled once more for a robot with a program: see CMakeLists.txt. */
#include "host_sim/program/native/programmed.h"

bool programmed_brain_start(struct brain *brain, uint8_t profile, uint32_t seed);
struct action programmed_brain_next(struct brain *brain, const struct config *config, const struct senses *senses);

/* A program uses the memory layout of the article. */
bool programmed_brain_start(struct brain *brain, uint8_t profile, uint32_t seed)
{
    if (profile != PROFILE_ARTICLE || !brain_start(brain, profile, seed))
        return false;
    program_begin(programmed_program(brain));
    brain->wants_ranges = programmed_program(brain)->measures;
    return true;
}

struct action programmed_brain_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    struct program *program = programmed_program(brain);
    struct action action = program_next(program, brain, config, senses);

    programmed_decided(program);
    return action;
}
