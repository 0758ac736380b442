/* The functions that the robot calls as own_begin and own_next (the linker's --wrap): they call the user's. */
#include "host_sim/program/own/guard.h"

#include <setjmp.h>
#include <stdio.h>
#include <string.h>

#include "firmware/behaviours/behaviour.h"
#include "firmware/robot.h"

enum { BRANCHES_MAX = 1000000, FORWARD_MAX_MM = 1000, TURN_MAX_DEG = 360 };

static const unsigned REASONS = 1u << REASON_STOP | 1u << REASON_WANDER | 1u << REASON_TOWARD_FOOD
    | 1u << REASON_LOOK_AROUND | 1u << REASON_REMEMBERED | 1u << REASON_TRIAL | 1u << REASON_BOREDOM
    | 1u << REASON_EAT | 1u << REASON_PROGRAM;

const bool OWN_IS_LINKED = true;

bool __wrap_own_begin(struct brain *brain);
struct action __wrap_own_next(struct brain *brain, const struct config *config, const struct senses *senses);
bool __real_own_begin(struct brain *brain);
struct action __real_own_next(struct brain *brain, const struct config *config, const struct senses *senses);
void __sanitizer_cov_trace_pc(void);

/* The decision under way. */
static __thread struct {
    jmp_buf out;
    unsigned left;                 /* branches that it may still take; 0: none is under way */
    const void *last;              /* the last of them */
    const struct brain *brain;     /* as the robot has it */
    const struct senses *senses;
} now;

static char failure[GUARD_TEXT_MAX];   /* the first one, of any robot, */
static const void *failed;              /* and of which */

const char *own_failure(const void *robot)
{
    return !robot || robot == failed ? failure : "";
}

static const struct robot *robot_of(const struct brain *brain)
{
    return (const struct robot *)((const char *)brain - offsetof(struct robot, brain));
}

static void add(char *text, size_t size, const char *more)
{
    strncat(text, more, size - strlen(text) - 1);
}

void guard_when(char *text, size_t size)
{
    static const char *const names[] = FEEL_NAMES;
    const struct robot *robot = robot_of(now.brain);
    unsigned long ms = robot->uptime_s * 1000UL + robot->part_ms;

    if (!now.senses) {
        snprintf(text, size, "at the start of the run");
        return;
    }
    snprintf(text, size, "at tick %lu, %.2f s, with ", ms / robot->config.value[TICK_MS], (double)ms / 1000);
    for (unsigned i = 0; i < FEEL_COUNT; i++)
        if (now.senses->feel & 1u << i) {
            add(text, size, names[i]);
            add(text, size, " and ");
        }
    if (now.senses->feel == 0)
        add(text, size, "nothing ");
    else
        text[strlen(text) - strlen("and ")] = '\0';
    add(text, size, now.senses->feel ? "blocked" : "in the way");
    add(text, size, now.senses->look ? ", food ahead" : ", no food seen");
}

void guard_fail(const void *code, const char *place, const char *what)
{
    char text[GUARD_TEXT_MAX], when[GUARD_TEXT_MAX / 3];

    if (now.left == 0)
        return;
    now.left = 0;
    guard_watch(false);
    text[0] = '\0';
    if (place)
        add(text, sizeof text, place);
    else
        guard_place(code, text, sizeof text);
    add(text, sizeof text, text[0] ? ": " : "");
    add(text, sizeof text, what);
    add(text, sizeof text, ", ");
    guard_when(when, sizeof when);
    add(text, sizeof text, when);
    guard_end(text);
    if (!failure[0]) {
        memcpy(failure, text, sizeof failure);
        failed = robot_of(now.brain);
    }
    longjmp(now.out, 1);
}

/* gcc and clang call this in each basic block of code compiled with -fsanitize-coverage=trace-pc. */
void __sanitizer_cov_trace_pc(void)
{
    if (now.left == 0)
        return;
    now.last = __builtin_return_address(0);
    if (now.left == 1)
        guard_fail(now.last, NULL, "a loop without an end: a million branches in one decision");
    now.left--;
}

static void enter(const struct brain *brain, const struct senses *senses)
{
    now.brain = brain;
    now.senses = senses;
    now.left = BRANCHES_MAX;
    guard_watch(true);
}

static void leave(void)
{
    guard_watch(false);
    now.left = 0;
}

static void complain(const char *what)
{
    guard_fail(now.last, NULL, what);
}

static void check_action(const struct action *action)
{
    char told[GUARD_TEXT_MAX / 3];

    if ((unsigned)action->reason > UINT8_MAX) {
        complain("the reason of the action was never set");
    } else if (action->reason > REASON_PROGRAM || !(REASONS & 1u << action->reason)) {
        snprintf(told, sizeof told, "%u is not a reason of an action", (unsigned)action->reason);
        complain(told);
    } else if (action->turn_deg < -TURN_MAX_DEG || action->turn_deg > TURN_MAX_DEG) {
        snprintf(told, sizeof told, "a turn by %d degrees is more than %d", action->turn_deg, TURN_MAX_DEG);
        complain(told);
    } else if (action->forward_mm < -FORWARD_MAX_MM || action->forward_mm > FORWARD_MAX_MM) {
        snprintf(told, sizeof told, "a step of %d mm is more than %d", action->forward_mm, FORWARD_MAX_MM);
        complain(told);
    } else if (action->turn_deg != 0 && action->forward_mm != 0)
        complain("an action is a step or a turn, not both");
}

static void check_memory(const struct brain *before, const struct brain *after)
{
    bool same = memcmp(&before->memory, &after->memory, sizeof before->memory) == 0;

    if (!memory_is(after->memory.cell, (enum memory_kind)BRAIN_MEMORY_KINDS[PROFILE_OWN]))
        complain("brain->memory holds a byte that is no side: use memory_learn");
    else if (!same && before->frozen)
        complain("brain->memory was changed although brain->frozen is true");
    else if (!same && !after->changed)
        complain("brain->memory was changed without brain->changed = true");
}

#define CHECK_FIELD(field)                 \
    if (before->field != after->field)     \
        complain("brain->" #field " was changed, which is the robot's");

static void check_brain(const struct brain *before, const struct brain *after)
{
    CHECK_FIELD(profile)
    CHECK_FIELD(used)
    CHECK_FIELD(unlearned)
    CHECK_FIELD(chasing)
    CHECK_FIELD(ate)
    CHECK_FIELD(lost)
    CHECK_FIELD(since_mm)
    CHECK_FIELD(learns)
    CHECK_FIELD(wants_ranges)
    CHECK_FIELD(frozen)
    check_memory(before, after);
}

/* The user's functions get copies: what they write beside these, the robot does not have. */
bool __wrap_own_begin(struct brain *brain)
{
    struct brain mine = *brain;
    bool learns;

    enter(brain, NULL);
    if (failure[0] || setjmp(now.out))
        return false;
    learns = __real_own_begin(&mine);
    check_brain(brain, &mine);
    leave();
    *brain = mine;
    return learns;
}

struct action __wrap_own_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    struct brain mine = *brain;
    struct config settings;
    struct senses sensed;
    struct action action;

    memcpy(&settings, config, sizeof settings);
    memcpy(&sensed, senses, sizeof sensed);
    enter(brain, senses);
    if (failure[0] || setjmp(now.out)) {
        leave();
        return (struct action){.reason = REASON_STOP};
    }
    action = __real_own_next(&mine, &settings, &sensed);
    check_action(&action);
    check_brain(brain, &mine);
    if (memcmp(&settings, config, sizeof settings) != 0 || memcmp(&sensed, senses, sizeof sensed) != 0)
        complain("*config or *senses was changed: they are the robot's");
    leave();
    *brain = mine;
    return action;
}
