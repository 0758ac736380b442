"""Faults of the firmware for its unit tests to notice: functions that the linker puts in the place of the real ones.

Each says what the robot does wrong, whatever the source looks like.
"""

from typing import NamedTuple


class Fault(NamedTuple):
    """A wrong function in the place of a right one.

    Attributes:
        module: Whose unit tests are to notice.
        function: Which one is replaced.
        body: Body of the wrong one; `real` is the right one.
    """

    module: str
    function: str
    body: str


# Each function that is replaced: what it returns, and its parameters.
NEXT = ("struct action", "struct brain *brain, const struct config *config, const struct senses *senses")
FUNCTIONS = {
    "pattern_of": ("uint8_t", "uint8_t feel"),
    "pattern_count": ("uint8_t", "uint8_t pattern"),
    "memory_adopt": ("bool", "struct memory *memory, const uint8_t cells[CELL_COUNT]"),
    "random_next": ("uint32_t", "struct random *random"),
    "random_below": ("uint8_t", "struct random *random, uint8_t n"),
    "config_fits": ("bool", "uint8_t parameter, uint32_t value"),
    "listing_trial_helped": ("bool", "const struct brain *brain, const struct senses *senses"),
    "article_next": NEXT,
    "fixed_next": NEXT,
    "never_next": NEXT,
    "rearmed_next": NEXT,
    "recheck_next": NEXT,
    "forgetful_next": NEXT,
    "adaptive_next": NEXT,
    "searcher_next": NEXT,
    "five_next": NEXT,
    "distance_next": NEXT,
    "memory_is": ("bool", "const uint8_t cells[CELL_COUNT], enum memory_kind kind"),
    "memory_translate": ("bool", "struct memory *memory, enum memory_kind kind"),
    "feel_memory_is": ("bool", "const uint8_t cells[CELL_COUNT]"),
    "confidence_changed": ("uint8_t", "uint8_t cell, int by"),
    "brain_start": ("bool", "struct brain *brain, uint8_t profile, uint32_t seed"),
    "perception_filter": ("uint8_t", "struct perception *perception, const struct config *config, uint8_t feel"),
    "perception_decide": ("void", "struct perception *perception, const struct config *config, uint8_t feel"),
    "motion_rest": ("bool", "struct motion *motion, const struct config *config"),
    "motion_begin": ("void", "struct motion *motion, const struct config *config, const struct action *action"),
    "motion_track": ("void", "struct motion *motion, const struct senses *senses"),
    "motion_ended": ("bool", "const struct motion *motion, const struct config *config, const struct senses *senses"),
    "robot_execute": ("enum result", "struct robot *robot, const struct command *command"),
    "robot_respond": (
        "void",
        "struct robot *robot, enum input_kind kind, const struct input *in, struct output *out",
    ),
}
RESPOND = "real(robot, kind, in, out);"
FAULTS = {
    "pattern counts two sensors only": Fault("pattern", "pattern_count", "return real(pattern & 3);"),
    "pattern is one bit off": Fault("pattern", "pattern_of", "return real(feel >> 1);"),
    "memory takes a side for cell 0": Fault(
        "memory_write",
        "memory_adopt",
        """
        uint8_t allowed[CELL_COUNT];
        memcpy(allowed, cells, sizeof allowed);
        allowed[0] = SIDE_NOTHING;
        return real(memory, allowed) && (memory->cell[0] = cells[0], true);
        """,
    ),
    "memory takes what is no side": Fault(
        "memory_write",
        "memory_adopt",
        """
        uint8_t allowed[CELL_COUNT];
        for (unsigned p = 0; p < CELL_COUNT; p++)
            allowed[p] = cells[p] > SIDE_RIGHT ? SIDE_RIGHT : cells[p];
        return real(memory, allowed);
        """,
    ),
    "dice favour small numbers": Fault("random", "random_below", "return (random_next(random) >> 24) % n;"),
    "dice miss every other number": Fault("random", "random_next", "real(random); return real(random);"),
    "a range is open at its end": Fault(
        "config", "config_fits", "return real(parameter, value) && real(parameter, value + 1);"
    ),
    "left is right": Fault(
        "article_learning",
        "article_next",
        "struct action action = real(brain, config, senses); action.turn_deg = -action.turn_deg; return action;",
    ),
    "boredom never ends": Fault(
        "article_boredom",
        "article_next",
        """
        struct action action = real(brain, config, senses);
        if (action.reason == REASON_REMEMBERED && brain->repeat_count >= config->value[BOREDOM_LIMIT])
            brain->awaits = AWAITS_BOREDOM;
        return action;
        """,
    ),
    "a clear way does not end the count": Fault(
        "article_boredom",
        "article_next",
        """
        uint8_t before = brain->repeat_count;
        struct action action = real(brain, config, senses);
        if (action.forward_mm != 0)
            brain->repeat_count = before;
        return action;
        """,
    ),
    "no better is good enough": Fault(
        "article_learning",
        "listing_trial_helped",
        """
        return brain->awaits == AWAITS_VERDICT
            && pattern_count(pattern_of(senses->feel)) <= pattern_count(pattern_of(brain->tried_feel));
        """,
    ),
    "the lesson goes to another cell": Fault(
        "article_learning",
        "article_next",
        """
        uint8_t tried = pattern_of(brain->tried_feel), before = brain->memory.cell[tried];
        struct action action = real(brain, config, senses);
        if (brain->memory.cell[tried] != before) {
            brain->memory.cell[pattern_of(senses->feel)] = brain->memory.cell[tried];
            brain->memory.cell[tried] = before;
        }
        return action;
        """,
    ),
    "a frozen brain learns": Fault(
        "article_learning",
        "article_next",
        """
        bool frozen = brain->frozen;
        brain->frozen = false;
        struct action action = real(brain, config, senses);
        brain->frozen = frozen;
        return action;
        """,
    ),
    "food is eaten one millimetre too far": Fault(
        "article",
        "article_next",
        """
        struct senses nearer = *senses;
        nearer.beacon_mm -= nearer.beacon_mm > 0;
        return real(brain, config, &nearer);
        """,
    ),
    "fixed learns": Fault("fixed", "fixed_next", "return article_next(brain, config, senses);"),
    "never remembers": Fault("never", "never_next", "return fixed_next(brain, config, senses);"),
    "rearmed is bored once": Fault("rearmed", "rearmed_next", "return article_next(brain, config, senses);"),
    "recheck checks nothing": Fault("recheck", "recheck_next", "return article_next(brain, config, senses);"),
    "forgetful forgets nothing": Fault("forgetful", "forgetful_next", "return rearmed_next(brain, config, senses);"),
    "adaptive forgets at once": Fault("adaptive", "adaptive_next", "return forgetful_next(brain, config, senses);"),
    "searcher does not search": Fault("searcher", "searcher_next", "return adaptive_next(brain, config, senses);"),
    "five has three sensors": Fault(
        "five",
        "five_next",
        "struct senses front = *senses; front.feel &= 14; return real(brain, config, &front);",
    ),
    "distance does not measure": Fault("distance", "distance_next", "return article_next(brain, config, senses);"),
    "a memory is of every kind": Fault(
        "memory_kind", "memory_is", "(void)real; (void)cells; (void)kind; return true;"
    ),
    "a memory of another kind is used as it is": Fault(
        "brain", "memory_translate", "(void)memory; return kind != MEMORY_KIND_SIDES && false;"
    ),
    "a memory without its mark is taken": Fault(
        "feel_memory",
        "feel_memory_is",
        """
        uint8_t marked[CELL_COUNT];
        memcpy(marked, cells, sizeof marked);
        marked[0] |= 0x0F;
        return real(marked);
        """,
    ),
    "an empty cell is praised": Fault(
        "confidence", "confidence_changed", "return cell ? real(cell, by) : by > 0 ? 4 : 0;"
    ),
    "an unknown profile is that of the article": Fault(
        "brain", "brain_start", "return real(brain, profile < PROFILE_COUNT ? profile : PROFILE_ARTICLE, seed);"
    ),
    "a filter believes any of three ticks": Fault(
        "perception",
        "perception_filter",
        """
        uint8_t any = feel | perception->before[0] | perception->before[1];
        uint8_t filtered = real(perception, config, feel);
        return config->value[FILTER] ? any : filtered;
        """,
    ),
    "distrust is for ever": Fault(
        "perception",
        "perception_decide",
        "real(perception, config, feel | perception->in_a_row[2] ? feel | 4 : feel);",
    ),
    "a trial is judged before the filter has settled": Fault(
        "perception", "motion_rest", "(void)config; motion->rest_ticks = 0; return false;"
    ),
    "turns forget what the last one missed": Fault(
        "motion", "motion_begin", "motion->turn_left = 0; real(motion, config, action);"
    ),
    "odometers do not wrap": Fault(
        "motion",
        "motion_track",
        """
        if (abs(senses->odometer_left - motion->odometer_left) >= ODOMETER_SPAN / 2)
            motion->referenced = false;
        real(motion, senses);
        """,
    ),
    "a step runs into the obstacle": Fault(
        "motion",
        "motion_ended",
        "struct senses clear = *senses; clear.feel = 0; return real(motion, config, &clear);",
    ),
    "stuck wheels are waited for": Fault(
        "motion",
        "motion_track",
        "uint16_t before = motion->ticks_left; real(motion, senses); motion->ticks_left = before;",
    ),
    "silence drives on": Fault(
        "robot_silence",
        "robot_respond",
        f"{RESPOND} if (kind == INPUT_SILENCE) motion_drive(&robot->motion, &robot->config, &out->drive);",
    ),
    "silence names no tick": Fault(
        "robot_silence", "robot_respond", f"{RESPOND} if (kind == INPUT_SILENCE) out->drive.tick = 0;"
    ),
    "trials eat": Fault("robot", "robot_respond", f"{RESPOND} out->drive.eat |= out->drive.reason == REASON_TRIAL;"),
    "what is not learned is stored": Fault(
        "robot_answers", "robot_respond", f"{RESPOND} out->store = out->has_memory;"
    ),
    "a stop goes on": Fault(
        "commands",
        "robot_execute",
        "bool before = robot->running; enum result result = real(robot, command); robot->running = before;"
        "return result;",
    ),
    "a start forgets": Fault(
        "commands",
        "robot_execute",
        "if (command->opcode == OPCODE_START) memory_erase(&robot->brain.memory); return real(robot, command);",
    ),
}
