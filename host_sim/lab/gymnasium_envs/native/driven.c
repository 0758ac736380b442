#include "host_sim/lab/gymnasium_envs/native/driven.h"

#include "firmware/motion/motion.h"

enum { ABOUT_DEG = 180 };

struct doing {
    const struct config *config;
    const uint8_t *actions;
    size_t under_way;       /* robots whose actions have not ended */
    bool rests[NODE_MAX];   /* by robot: whether its action has ended */
    uint32_t end_tick;      /* tick after the step */
};

static struct action action_of(uint8_t action, const struct config *config)
{
    int16_t turn_deg = config->value[TURN_DEG], try_deg = config->value[TRIAL_DEG];

    switch (action) {
    case DRIVEN_TURN_LEFT:
        return (struct action){.turn_deg = (int16_t)-turn_deg};
    case DRIVEN_TURN_RIGHT:
        return (struct action){.turn_deg = turn_deg};
    case DRIVEN_TRY_LEFT:
        return (struct action){.turn_deg = (int16_t)-try_deg};
    case DRIVEN_TRY_RIGHT:
        return (struct action){.turn_deg = try_deg};
    case DRIVEN_TURN_ABOUT:
        return (struct action){.turn_deg = ABOUT_DEG};
    default:
        return (struct action){.forward_mm = config->value[STEP_MM]};
    }
}

static void sense(struct driven *driven, size_t i, struct senses *senses)
{
    struct driven_robot *robot = &driven->robots[i];

    world_sense(driven->world, &driven->world->bodies[i], driven->tick, senses);
    robot->senses[0] = senses->tick;
    robot->senses[1] = senses->feel;
    robot->senses[2] = senses->bump;
    robot->senses[3] = senses->look;
    robot->senses[4] = senses->beacon_mm;
    robot->senses[5] = senses->odometer_left;
    robot->senses[6] = senses->odometer_right;
}

static void rest(struct driven *driven, size_t i, struct doing *doing)
{
    motion_begin(&driven->motions[i], doing->config, &(struct action){0});
    doing->under_way--;
    doing->rests[i] = true;
}

static void eat(struct driven *driven, size_t i, const struct doing *doing)
{
    if (doing->actions[i] == DRIVEN_FORWARD && world_eat(driven->world, &driven->world->bodies[i]))
        driven->robots[i].food_eaten++;
}

static void move(struct driven *driven, size_t i, const struct config *config)
{
    struct drive drive;

    motion_drive(&driven->motions[i], config, &drive);
    world_move(driven->world, &driven->world->bodies[i], drive.left_mm_s, drive.right_mm_s);
}

static void run_tick(struct driven *driven, struct doing *doing)
{
    struct senses senses;

    for (size_t i = 0; i < driven->world->body_count; i++)
        move(driven, i, doing->config);
    driven->tick++;
    for (size_t i = 0; i < driven->world->body_count; i++) {
        sense(driven, i, &senses);
        motion_track(&driven->motions[i], &senses);
        if (!doing->rests[i] && motion_ended(&driven->motions[i], doing->config, &senses)) {
            rest(driven, i, doing);
            eat(driven, i, doing);
        }
    }
}

static bool goes_on(const struct driven *driven, const struct doing *doing)
{
    return doing->under_way > 0 && driven->tick < doing->end_tick && driven->tick < driven->limit_ticks
        && world_food_left(driven->world) > 0;
}

size_t driven_motion_size(void)
{
    return sizeof(struct motion);
}

void driven_begin(struct driven *driven)
{
    struct senses senses;

    driven->tick = 0;
    driven->food_left = (uint32_t)world_food_left(driven->world);
    for (size_t i = 0; i < driven->world->body_count; i++) {
        driven->robots[i].food_eaten = 0;
        driven->robots[i].collisions = 0;
        motion_start(&driven->motions[i]);
        sense(driven, i, &senses);
        motion_track(&driven->motions[i], &senses);
    }
}

static void begin_action(struct driven *driven, size_t i, const struct doing *doing)
{
    struct action action = action_of(doing->actions[i], doing->config);

    motion_begin(&driven->motions[i], doing->config, &action);
    driven->robots[i].food_eaten = 0;
    driven->robots[i].collisions = (uint32_t)driven->world->bodies[i].collisions;
}

static void step(struct driven *driven, const uint8_t actions[], const struct config *config)
{
    struct doing doing = {
        .config = config, .actions = actions, .under_way = driven->world->body_count,
        .end_tick = driven->tick + driven->step_ticks
    };
    const bool has_time = goes_on(driven, &doing);

    for (size_t i = 0; i < driven->world->body_count; i++)
        begin_action(driven, i, &doing);
    while (goes_on(driven, &doing))
        run_tick(driven, &doing);
    for (size_t i = 0; i < driven->world->body_count; i++) {
        if (has_time && !doing.rests[i])
            eat(driven, i, &doing);
        driven->robots[i].collisions = (uint32_t)driven->world->bodies[i].collisions - driven->robots[i].collisions;
    }
    driven->food_left = (uint32_t)world_food_left(driven->world);
}

void driven_step(struct driven all[], size_t count, const uint8_t actions[])
{
    struct config config;

    config_reset(&config);
    for (size_t i = 0; i < count; i++)
        step(&all[i], &actions[i * all[i].world->body_count], &config);
}
