#include "host_sim/lab/gymnasium_envs/native/told.h"

#include "firmware/motion/motion.h"

enum { ABOUT_DEG = 180 };

struct doing {
    const struct config *config;
    const uint8_t *deeds;
    size_t under_way;       /* robots whose actions have not ended */
    bool rests[NODE_MAX];   /* by robot: whether its action has ended */
    uint32_t end_tick;      /* tick after the step */
};

static struct action action_of(uint8_t deed, const struct config *config)
{
    int16_t turn_deg = config->value[TURN_DEG], try_deg = config->value[TRIAL_DEG];

    switch (deed) {
    case TOLD_TURN_LEFT:
        return (struct action){.turn_deg = (int16_t)-turn_deg};
    case TOLD_TURN_RIGHT:
        return (struct action){.turn_deg = turn_deg};
    case TOLD_TRY_LEFT:
        return (struct action){.turn_deg = (int16_t)-try_deg};
    case TOLD_TRY_RIGHT:
        return (struct action){.turn_deg = try_deg};
    case TOLD_TURN_ABOUT:
        return (struct action){.turn_deg = ABOUT_DEG};
    default:
        return (struct action){.forward_mm = config->value[STEP_MM]};
    }
}

static void sense(struct told *told, size_t i, struct senses *senses)
{
    struct told_robot *robot = &told->robots[i];

    world_sense(told->world, &told->world->bodies[i], told->tick, senses);
    robot->senses[0] = senses->tick;
    robot->senses[1] = senses->feel;
    robot->senses[2] = senses->bump;
    robot->senses[3] = senses->look;
    robot->senses[4] = senses->beacon_mm;
    robot->senses[5] = senses->odometer_left;
    robot->senses[6] = senses->odometer_right;
}

static void rest(struct told *told, size_t i, struct doing *doing)
{
    motion_begin(&told->motions[i], doing->config, &(struct action){0});
    doing->under_way--;
    doing->rests[i] = true;
}

static void eat(struct told *told, size_t i, const struct doing *doing)
{
    if (doing->deeds[i] == TOLD_FORWARD && world_eat(told->world, &told->world->bodies[i]))
        told->robots[i].food_eaten++;
}

static void move(struct told *told, size_t i, const struct config *config)
{
    struct drive drive;

    motion_drive(&told->motions[i], config, &drive);
    world_move(told->world, &told->world->bodies[i], drive.left_mm_s, drive.right_mm_s);
}

static void run_tick(struct told *told, struct doing *doing)
{
    struct senses senses;

    for (size_t i = 0; i < told->world->body_count; i++)
        move(told, i, doing->config);
    told->tick++;
    for (size_t i = 0; i < told->world->body_count; i++) {
        sense(told, i, &senses);
        motion_track(&told->motions[i], &senses);
        if (!doing->rests[i] && motion_ended(&told->motions[i], doing->config, &senses)) {
            rest(told, i, doing);
            eat(told, i, doing);
        }
    }
}

static bool goes_on(const struct told *told, const struct doing *doing)
{
    return doing->under_way > 0 && told->tick < doing->end_tick && told->tick < told->limit_ticks
        && world_food_left(told->world) > 0;
}

size_t told_motion_size(void)
{
    return sizeof(struct motion);
}

void told_begin(struct told *told)
{
    struct senses senses;

    told->tick = 0;
    told->food_left = (uint32_t)world_food_left(told->world);
    for (size_t i = 0; i < told->world->body_count; i++) {
        told->robots[i].food_eaten = 0;
        told->robots[i].collisions = 0;
        motion_start(&told->motions[i]);
        sense(told, i, &senses);
        motion_track(&told->motions[i], &senses);
    }
}

static void begin_deed(struct told *told, size_t i, const struct doing *doing)
{
    struct action action = action_of(doing->deeds[i], doing->config);

    motion_begin(&told->motions[i], doing->config, &action);
    told->robots[i].food_eaten = 0;
    told->robots[i].collisions = (uint32_t)told->world->bodies[i].collisions;
}

static void step(struct told *told, const uint8_t deeds[], const struct config *config)
{
    struct doing doing = {
        .config = config, .deeds = deeds, .under_way = told->world->body_count,
        .end_tick = told->tick + told->step_ticks
    };
    const bool has_time = goes_on(told, &doing);

    for (size_t i = 0; i < told->world->body_count; i++)
        begin_deed(told, i, &doing);
    while (goes_on(told, &doing))
        run_tick(told, &doing);
    for (size_t i = 0; i < told->world->body_count; i++) {
        if (has_time && !doing.rests[i])
            eat(told, i, &doing);
        told->robots[i].collisions = (uint32_t)told->world->bodies[i].collisions - told->robots[i].collisions;
    }
    told->food_left = (uint32_t)world_food_left(told->world);
}

void told_step(struct told all[], size_t count, const uint8_t deeds[])
{
    struct config config;

    config_reset(&config);
    for (size_t i = 0; i < count; i++)
        step(&all[i], &deeds[i * all[i].world->body_count], &config);
}
