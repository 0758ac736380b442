/* page.h: a run for a web page. JavaScript calls these functions of page.wasm and reads their results in its memory.
 *
 * The page has an instance of the module for each run, so that a run's state is the whole memory of its instance: a
 * copy of that memory is a snapshot of the run. Robot i has node i + 1. */
#ifndef OCTET_PAGE_H
#define OCTET_PAGE_H

#include "hal/library/exchange.h"
#include "host_sim/program/native/programmed.h"
#include "host_sim/sim/native/loop.h"
#include "host_sim/world/native/edits.h"
#include "host_sim/world/native/kit/kit.h"
#include "host_sim/world/native/history.h"
#include "host_sim/world/native/draw/layout.h"
#include "host_sim/world/native/draw/tour.h"
#include "host_sim/world/native/space/plain_space.h"
#include "host_sim/world/native/ranges.h"
#include "host_sim/world/native/draw/written.h"

enum {
    PAGE_TICKS_MAX = 256,   /* of a block */
    PAGE_WAITING_MAX = 64,  /* frames of a robot that have not been taken yet */
    PAGE_BYTES = 8,
    PAGE_TEXT_MAX = EDIT_TEXT_MAX
};

/* The dimensions of a world, as in SimParams. */
enum { PAGE_WIDTH_MM, PAGE_HEIGHT_MM, PAGE_BODY_MM, PAGE_TRACK_MM, PAGE_REACH_MM, PAGE_FRONT_EXTRA_MM, PAGE_BEAM_MM,
       PAGE_EAT_MM, PAGE_TICK_S, PAGE_SPEED_MM_S, PAGE_THICKNESS_MM, PAGE_DIMENSIONS };

/* The numbers of an edit, as in struct edit; each of the last three places has two. */
enum { PAGE_EDIT_ID, PAGE_EDIT_ROBOT, PAGE_EDIT_SEED, PAGE_EDIT_HEADING, PAGE_EDIT_RADIUS, PAGE_EDIT_A,
       PAGE_EDIT_B = PAGE_EDIT_A + 2, PAGE_EDIT_AT = PAGE_EDIT_B + 2 };

enum { PAGE_NUMBERS = PAGE_DIMENSIONS };   /* maximum that JavaScript passes, except for layouts */

/* What layouts are drawn from, as in struct layout_kind; the bands of food are pairs of numbers. */
enum { PAGE_DRAW_STYLE, PAGE_DRAW_WIDTH_MM, PAGE_DRAW_HEIGHT_MM, PAGE_DRAW_BODY_MM, PAGE_DRAW_REACH_MM,
       PAGE_DRAW_THICKNESS_MM, PAGE_DRAW_BAR_COUNT, PAGE_DRAW_BAR_MIN_MM, PAGE_DRAW_BAR_MAX_MM, PAGE_DRAW_FOOD_COUNT,
       PAGE_DRAW_FOOD, PAGE_DRAW_NUMBERS = PAGE_DRAW_FOOD + 2 * LAYOUT_FOOD_MAX };

/* Where robots are. */
struct page_world {
    struct world world;
    struct plain_world space;
    struct cones cones;
    struct ranges ranges;
    struct ranges kit_ranges;   /* the same, as far as any sensor of a real body reaches */
    struct body bodies[PAGE_ROBOTS_MAX];
    struct kit_kind kind;       /* of the bodies, */
    bool is_real;               /* unless they are ideal */
    struct kit kits[PAGE_ROBOTS_MAX];
    struct food food[LAYOUT_FOOD_MAX];
    struct furniture furniture;
    struct plain_place places[PAGE_ROBOTS_MAX];
    uint64_t touching[PLAIN_WORDS(FURNITURE_CAPSULES_MAX + PAGE_ROBOTS_MAX) * (PAGE_ROBOTS_MAX + 1)];
};

/* A run. */
struct page {
    struct page_world world;
    struct history histories[PAGE_ROBOTS_MAX];
    struct history_note notes[PAGE_TICKS_MAX];   /* of the last page_history_take */
    struct loop loop;
    struct loop_robot robots[PAGE_ROBOTS_MAX];
    struct frame waiting[PAGE_ROBOTS_MAX][PAGE_WAITING_MAX];
    uint8_t counters[PAGE_ROBOTS_MAX];   /* of the last command */
    uint32_t answer_value;
    struct command command;              /* read last */
    uint8_t bytes[PAGE_BYTES];
    double numbers[PAGE_NUMBERS];
    char text[PAGE_TEXT_MAX];
};

struct page *page_state(void);
        /* The run of this instance. */

bool page_open(uint32_t robots);
        /* Creates the robots of a run, 1..PAGE_ROBOTS_MAX, with empty memories. False if out of memory. */

void page_bind(struct loop_robot *robot, struct octet *octet);
        /* Makes this the robot at a place of the run. */

struct octet *page_octet(uint32_t robot);
        /* The robot itself. */

void page_hear(uint32_t robot, const struct frame *frame);
        /* Sends a robot a frame. Its answers wait to be taken; there is room for PAGE_WAITING_MAX frames, and further
           ones are lost. */

size_t page_exchange(uint32_t robot, uint32_t id, uint32_t len);
        /* Sends a robot the frame with the bytes in page_bytes(). Returns the number of its page_answers(). */

uint8_t *page_bytes(void);
        /* Buffer of 8 bytes for what JavaScript passes. */

const struct frame *page_answers(uint32_t robot);
        /* The robot's last answers. */

int32_t page_command(uint32_t robot, uint32_t opcode, uint32_t which, uint32_t value);
        /* Sends a command, with which and value as in struct command, and logs it and the robot's frames up to its
           answer. Returns the answer's result, an enum result; -1 if there was none. */

uint32_t page_answer_value(void);
        /* The value of that answer. */

uint32_t page_read_command(uint32_t robot);
        /* Decodes page_bytes() as a COMMAND, as a robot does that has heard none before. Returns its opcode, */

uint32_t page_command_which(void);
        /* its field which, as in struct command, */

uint32_t page_command_value(void);
        /* and its value. */

void page_take_reports(uint32_t robot);
        /* Logs all waiting frames of the robot. */

const uint8_t *page_memory(uint32_t robot);
        /* The robot's eight bytes. */

const uint8_t *page_sides(uint32_t robot);
        /* The turn for each pattern in them, for any kind of memory. */

void page_write_side(uint32_t robot, uint32_t pattern, uint32_t side);
        /* Sets the turn for a pattern in page_bytes(), which hold a memory for this robot's behaviour. */

bool page_translate(uint32_t robot);
        /* Makes the memory in page_bytes() one for this robot's behaviour. False if they are not a memory. */

bool page_has_halted(uint32_t robot);
        /* Whether it has stopped by itself because its wheels do not obey. */

void page_set_time(double time_us);
        /* Sets the time of the log lines that follow. */

const char *page_log(void);
        /* The log's lines since the last page_clear_log, */

size_t page_log_used(void);
        /* and their length. */

void page_clear_log(void);

/* page_world.c: the world around them. */

double *page_numbers(void);
        /* Buffer for dimensions or the numbers of an edit from JavaScript. */

char *page_text(void);
        /* Buffer of PAGE_TEXT_MAX bytes for a text from JavaScript. */

void page_set_bodies(uint32_t is_real, uint32_t is_kit);
        /* Makes the bodies of the next page_build ideal, or real: those of the kit, changed by page_set_trait. */

bool page_set_trait(double value, double tolerance);
        /* Sets the trait named in page_text(). False if there is none, or the value is out of range. */

void page_draw_bodies(uint32_t seed);
        /* Draws each robot's body from the seed of the run. */

void page_build(void);
        /* Builds the arena with the dimensions in page_numbers(). */

void page_enter(void);
        /* Begins the environment that page_draw has drawn. */

const char *page_edit(int32_t kind);
        /* As edit_make, with what is in page_numbers() and page_text(). */

const double *page_scene(void);
        /* The numbers of bars, of plants and of pieces of food, then id and ends of each bar, id, middle and radius
           of each plant, and of each piece of food its place and whether it is eaten. */

void page_send_ranges(uint32_t robot, uint32_t tick);
        /* Sends and logs the RANGES of its body, which precede the senses of a tick. */

uint32_t page_run(uint32_t tick, uint32_t ticks_max);
        /* Runs a block, as loop_run does, from this tick of the run. ticks_max is 1..PAGE_TICKS_MAX. Returns the
           number of ticks run. */

const int16_t *page_rows(uint32_t robot);
        /* For each tick of the block ROW_COUNT numbers, */

const double *page_poses(uint32_t robot);
        /* and LOOP_POSE numbers. */

/* page_memory.c: what a robot has learned. */

void page_history_begin(uint32_t robot);
        /* As history_begin. */

uint32_t page_history_take(uint32_t robot, double tick);
        /* history_take and history_learn of the last block, begun at tick. Returns the number of page_notes(). */

void page_history_relearn(uint32_t robot, double tick);
void page_history_restart(uint32_t robot);
        /* As history_relearn and history_restart. */

void page_history_freeze(uint32_t robot, uint32_t on);
        /* Sets whether learning is frozen from now on. */

const struct history_note *page_notes(void);
        /* Those of the last page_history_take. */

const struct history_lesson *page_lessons(uint32_t robot);
uint32_t page_lesson_count(uint32_t robot);
        /* The lessons of the last take or relearn. */

/* page_program.c: robots whose brain is a program. */

char *page_program_text(void);
        /* Buffer of PROGRAM_TEXT_MAX bytes for a program from JavaScript. */

bool page_program(uint32_t robot, uint32_t len);
        /* Replaces a robot that was never started by one with that program for a brain and an empty memory. False if
           out of memory. */

enum { PAGE_PROGRAM_ENDED, PAGE_PROGRAM_LINE, PAGE_PROGRAM_EXPECTED, PAGE_PROGRAM_CELLS, PAGE_PROGRAM_SHOWN,
       PAGE_PROGRAM_STEPS, PAGE_PROGRAM_VARIABLES, PAGE_PROGRAM_NUMBERS };

const double *page_program_state(uint32_t robot);
        /* Of a robot's program: 1 if it has ended, else 0; the line of its mistake and what was expected, 0 if it has
           none; the numbers of its cells, of the texts that it shows, of the steps of its last decision, and of its
           variables and arrays; then line, cell and value of each step, and first cell, size, and place and length in
           the text of each variable and array. */

const double *page_program_cells(uint32_t robot);
        /* Its cells before the last decision. */

const char *page_program_word(uint32_t robot);
        /* The word of its mistake. */

const char *page_program_expected(uint32_t expected);
        /* As program_expected. */

const char *page_program_shown(uint32_t robot, uint32_t place);
        /* A text that it shows, from place 0 on. */

const char *page_program_printed(uint32_t robot);
        /* What it has printed, in lines. */

/* page_layouts.c: the initial layouts of environments. */

double *page_drawing(void);
        /* Buffer of PAGE_DRAW_NUMBERS numbers, from which layouts are drawn. */

void page_write_nothing(void);
        /* Clears the written world. A written world takes precedence over the style. */

void page_write_list(uint32_t key, int32_t count);
        /* As written_list, */

double *page_write_entry(uint32_t key, uint32_t index, int32_t count);
        /* and as written_entry: where JavaScript puts the entry's numbers; null beyond the arrays. */

const double *page_check(void);
        /* The first fault of the written world: key, entry, number of values, values, as in struct written_fault;
           null if it is a fair world. */

const char *page_fault_text(void);
        /* That fault in words. */

struct layout *page_drawn(void);
        /* The layout that page_draw has drawn. */

const double *page_draw(double seed, double number, uint32_t robots);
        /* Draws an environment for 1..PAGE_ROBOTS_MAX robots. Returns the numbers of bars, of pieces of food and
           of starts, and then these, as in struct layout. There are fewer starts than robots if there is no room for
           all; none if 1000 draws gave no fair layout. */

double page_tour(void);
        /* The length of the shortest tour through all food of that environment, mm, from the first robot's start;
           infinite if none was found. */

#endif
