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

struct decision {
    jmp_buf out;
    unsigned left;                 /* branches that it may still take */
    const void *last;              /* the last of them */
    const struct brain *brain;     /* as the robot has it */
    const struct senses *senses;   /* NULL at the start of a run */
};

/* The one under way in this thread, or NULL. It is looked up at every branch: that must not take a call. */
static __thread struct decision *now __attribute__((tls_model("initial-exec")));

static char failure[GUARD_TEXT_MAX];   /* the first failure of any robot, */
static const void *failed;              /* and the robot */

const char *own_failure(const void *robot)
{
    return !robot || robot == failed ? failure : "";
}

static const struct robot *robot_of(const struct brain *brain)
{
    return (const struct robot *)((const char *)brain - offsetof(struct robot, brain));
}

long guard_when(char *text, size_t size)
{
    static const char *const names[] = FEEL_NAMES;

    if (!now || !now->senses) {
        snprintf(text, size, "at the start of the run");
        return -1;
    }
    const struct robot *robot = robot_of(now->brain);
    unsigned long ms = robot->uptime_s * 1000UL + robot->part_ms;
    long tick = (long)(ms / robot->config.value[TICK_MS]);

    char felt[GUARD_TEXT_MAX / 6] = "";
    for (unsigned i = 0; i < FEEL_COUNT; i++)
        if (now->senses->feel & 1u << i) {
            strcat(felt, felt[0] ? " and " : "");
            strcat(felt, names[i]);
        }
    snprintf(text, size, "at tick %ld, %.2f s, with %s %s, %s", tick, (double)ms / 1000, felt[0] ? felt : "nothing",
             felt[0] ? "blocked" : "in the way", now->senses->look ? "food ahead" : "no food seen");
    return tick;
}

void guard_fail(const void *code, const char *place, const char *what)
{
    char text[GUARD_TEXT_MAX], found[GUARD_TEXT_MAX / 2] = "", when[GUARD_TEXT_MAX / 3];
    struct decision *decision = now;

    if (!decision)
        return;
    guard_watch(false);
    if (!place)
        guard_place(code, found, sizeof found);
    place = place ? place : found;
    long tick = guard_when(when, sizeof when);
    snprintf(text, sizeof text, "%ld %s%s%s, %s", tick, place, place[0] ? ": " : "", what, when);
    guard_end(text);
    if (!failure[0]) {
        memcpy(failure, text, sizeof failure);
        failed = robot_of(decision->brain);
    }
    now = NULL;
    longjmp(decision->out, 1);
}

/* gcc and clang call this in each basic block of code compiled with -fsanitize-coverage=trace-pc. */
void __sanitizer_cov_trace_pc(void)
{
    struct decision *decision = now;

    if (!decision)
        return;
    decision->last = __builtin_return_address(0);
    if (--decision->left == 0)
        guard_fail(decision->last, NULL, "a loop without an end: a million branches in one decision");
}

static void enter(struct decision *decision, const struct brain *brain, const struct senses *senses)
{
    decision->left = BRANCHES_MAX;
    decision->last = NULL;
    decision->brain = brain;
    decision->senses = senses;
    now = decision;
    guard_watch(true);
}

static void leave(void)
{
    guard_watch(false);
    now = NULL;
}

static void complain(const char *what)
{
    guard_fail(now->last, NULL, what);
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

/* The user's functions get copies, so that what they write beside these does not reach the robot. */
bool __wrap_own_begin(struct brain *brain)
{
    struct decision decision;
    struct brain mine = *brain;
    bool learns;

    if (failure[0] || setjmp(decision.out))
        return false;
    enter(&decision, brain, NULL);
    learns = __real_own_begin(&mine);
    check_brain(brain, &mine);
    leave();
    *brain = mine;
    return learns;
}

struct action __wrap_own_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    struct decision decision;
    struct brain mine = *brain;
    struct config settings;
    struct senses sensed;
    struct action action;

    memcpy(&settings, config, sizeof settings);
    memcpy(&sensed, senses, sizeof sensed);
    if (failure[0] || setjmp(decision.out))
        return (struct action){.reason = REASON_STOP};
    enter(&decision, brain, senses);
    action = __real_own_next(&mine, &settings, &sensed);
    check_action(&action);
    check_brain(brain, &mine);
    if (memcmp(&settings, config, sizeof settings) != 0 || memcmp(&sensed, senses, sizeof sensed) != 0)
        complain("*config or *senses was changed: they are the robot's");
    leave();
    *brain = mine;
    return action;
}
