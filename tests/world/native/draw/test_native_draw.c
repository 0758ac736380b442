#include "tests/test.h"
#include "host_sim/world/native/draw/draw.h"
#include "host_sim/world/native/draw/draws.h"
#include "host_sim/world/native/draw/written.h"

#include <math.h>
#include <string.h>

/* Draws of Python 3.11's random, and hashes of its hashlib. */
static struct draws draws;

TEST(first_draws_equal_those_of_python)
{
    draws_seed(&draws, "octet 1 1");
    TEST_ASSERT_EQUAL_DOUBLE(0x1.7d4265f35ff80p-4, draws_next(&draws));
    TEST_ASSERT_EQUAL_DOUBLE(0x1.222ee7a532ec6p-2, draws_next(&draws));
}

TEST(later_draws_equal_those_of_python)
{
    static const struct {
        unsigned at;
        double number;
    } later[] = {{311, 0x1.980cbaca01ff0p-4}, {312, 0x1.76f7f3a0f1094p-3}, {999, 0x1.04777fbe89209p-1}};
    double number = 0.0;
    unsigned at = 0;

    draws_seed(&draws, "octet 1 1");
    for (unsigned i = 0; i < sizeof later / sizeof *later; i++) {
        for (; at <= later[i].at; at++)
            number = draws_next(&draws);
        TEST_ASSERT_EQUAL_DOUBLE(later[i].number, number);
    }
}

TEST(seed_text_may_be_empty)
{
    draws_seed(&draws, "");
    TEST_ASSERT_EQUAL_DOUBLE(0x1.eba2b25d163e4p-1, draws_next(&draws));
}

TEST(seed_text_is_truncated_to_its_maximum)
{
    char text[DRAWS_TEXT_MAX + 2] = "";

    memset(text, 'x', DRAWS_TEXT_MAX + 1);
    draws_seed(&draws, text);
    TEST_ASSERT_EQUAL_DOUBLE(0x1.4a33c26cab4ebp-1, draws_next(&draws));
}

TEST(draws_between_uses_one_draw)
{
    draws_seed(&draws, "octet 1 1");
    TEST_ASSERT_EQUAL_DOUBLE(2.4654045021288677, draws_between(&draws, 2.0, 7.0));
    TEST_ASSERT_EQUAL_DOUBLE(0x1.222ee7a532ec6p-2, draws_next(&draws));
}

static void hash_of(const uint8_t *bytes, size_t count, uint8_t out[SHA512_BYTES])
{
    struct sha512 hash;

    sha512_begin(&hash);
    for (size_t at = 0; at < count; at += 7)
        sha512_add(&hash, &bytes[at], count - at < 7 ? count - at : 7);
    sha512_end(&hash, out);
}

/* The hash over the hashes of all lengths; Python's hashlib gives the same. */
TEST(sha512_of_0_to_300_bytes_matches_hashlib)
{
    static const uint8_t of_all[SHA512_BYTES] = {
        0xAC, 0x2E, 0xFB, 0x9C, 0x9A, 0xDB, 0xBD, 0x0A, 0x5C, 0x0E, 0x78, 0xEB, 0x0A, 0xB2, 0xF3, 0x82,
        0x2F, 0xA4, 0x2B, 0x9D, 0xAE, 0xF6, 0x85, 0x24, 0x9C, 0xB3, 0x1E, 0x94, 0x0D, 0xEF, 0x2D, 0xE2,
        0xF2, 0xBB, 0x88, 0x61, 0x68, 0x88, 0x41, 0xB7, 0xFD, 0x16, 0x48, 0xBE, 0x65, 0x88, 0xBA, 0xD1,
        0xB5, 0xBB, 0xFF, 0x71, 0xEC, 0x1F, 0x08, 0x62, 0xA5, 0x00, 0xC3, 0x94, 0x12, 0x1C, 0xE2, 0x3D,
    };
    uint8_t bytes[300], out[SHA512_BYTES];
    struct sha512 all;

    for (unsigned i = 0; i < sizeof bytes; i++)
        bytes[i] = (uint8_t)(i * 3);
    sha512_begin(&all);
    for (unsigned count = 0; count <= sizeof bytes; count++) {
        hash_of(bytes, count, out);
        sha512_add(&all, out, SHA512_BYTES);
    }
    sha512_end(&all, out);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(of_all, out, SHA512_BYTES);
}

TEST(sha512_of_abc_matches_the_standard)
{
    static const uint8_t expected[SHA512_BYTES] = {
        0xDD, 0xAF, 0x35, 0xA1, 0x93, 0x61, 0x7A, 0xBA, 0xCC, 0x41, 0x73, 0x49, 0xAE, 0x20, 0x41, 0x31,
        0x12, 0xE6, 0xFA, 0x4E, 0x89, 0xA9, 0x7E, 0xA2, 0x0A, 0x9E, 0xEE, 0xE6, 0x4B, 0x55, 0xD3, 0x9A,
        0x21, 0x92, 0x99, 0x2A, 0x27, 0x4F, 0xC1, 0xA8, 0x36, 0xBA, 0x3C, 0x23, 0xA3, 0xFE, 0xEB, 0xBD,
        0x45, 0x4D, 0x44, 0x23, 0x64, 0x3C, 0xE8, 0x0E, 0x2A, 0x9A, 0xC9, 0x4F, 0xA5, 0x4C, 0xA4, 0x9F,
    };
    uint8_t out[SHA512_BYTES];

    sha512((const uint8_t *)"abc", 3, out);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, out, SHA512_BYTES);
}

/* The draws of each style: where things are, and that they differ from draw to draw. */

enum { LAYOUTS = 50 };

static const struct layout_params PARAMS = {
    .width_mm = 4000.0, .height_mm = 3000.0, .body_radius_mm = 100.0, .sensor_reach_mm = 60.0, .bar_thickness_mm = 40.0,
    .bar_min_mm = 300.0, .bar_max_mm = 1000.0, .food_min_mm = {0.0, 2000.0}, .food_max_mm = {2000.0, 4000.0},
    .bar_count = 6, .food_count = 2,
};

static struct pose start;
static struct layout layout;
static struct written written;
static uint8_t cells[WRITTEN_CELLS_MAX];
static uint32_t stack[WRITTEN_CELLS_MAX];
static struct reach reach;

BEFORE_EACH(draw)
{
    draws_seed(&draws, "test");
    layout = (struct layout){.starts = &start};
    reach = (struct reach){.cells = cells, .stack = stack};
    written_clear(&written);
    written.food_count = written.bar_count = 1;
    written.food[0] = (struct written_entry){2, {500.0, 500.0}};
    written.bars[0] = (struct written_entry){4, {2000.0, 0.0, 2000.0, 3000.0}};
}

static double length(struct bar bar)
{
    return hypot(bar.b.x - bar.a.x, bar.b.y - bar.a.y);
}

static bool is_inside(struct vector at, double edge)
{
    return at.x >= edge && at.x <= PARAMS.width_mm - edge && at.y >= edge && at.y <= PARAMS.height_mm - edge;
}

static void expect_inside(double edge)
{
    for (uint32_t i = 0; i < layout.bar_count; i++) {
        TEST_ASSERT_TRUE(is_inside(layout.bars[i].a, edge));
        TEST_ASSERT_TRUE(is_inside(layout.bars[i].b, edge));
    }
}

TEST(pose_draws_x_then_y_then_heading)
{
    struct draws again = draws;
    struct pose pose = draw_pose(&draws, &PARAMS);
    double x = draws_between(&again, 0.0, 4000.0), y = draws_between(&again, 0.0, 3000.0);
    double heading = draws_between(&again, -DRAW_PI, DRAW_PI);

    TEST_ASSERT_EQUAL_DOUBLE(x, pose.at.x);
    TEST_ASSERT_EQUAL_DOUBLE(y, pose.at.y);
    TEST_ASSERT_EQUAL_DOUBLE(heading, pose.heading_rad);
}

TEST(food_is_drawn_in_its_band)
{
    for (unsigned n = 0; n < LAYOUTS; n++) {
        draw_food_and_start(&draws, &PARAMS, &layout);
        TEST_ASSERT_EQUAL_UINT32(2, layout.food_count);
        TEST_ASSERT_EQUAL_UINT32(1, layout.start_count);
        TEST_ASSERT_TRUE(layout.food[0].x < 2000.0 && layout.food[1].x >= 2000.0);
        TEST_ASSERT_TRUE(is_inside(layout.food[0], 0.0) && is_inside(layout.food[1], 0.0) && is_inside(start.at, 0.0));
    }
}

TEST(bars_keep_their_length_limits_inside_the_walls)
{
    for (unsigned n = 0; n < LAYOUTS; n++) {
        draw_bars(&draws, &PARAMS, &layout);
        TEST_ASSERT_EQUAL_UINT32(6, layout.bar_count);
        expect_inside(20.0 - 1e-9);
        for (unsigned i = 0; i < 6; i++)
            TEST_ASSERT_DOUBLE_WITHIN(350.0 + 1e-9, 650.0 - 40.0, length(layout.bars[i]));
    }
}

TEST(corridors_are_walls_with_one_door_each)
{
    unsigned upright = 0;

    for (unsigned n = 0; n < LAYOUTS; n++) {
        draw_corridors(&draws, &PARAMS, &layout);
        upright += layout.bars[0].a.x == layout.bars[0].b.x;
        TEST_ASSERT_EQUAL_UINT32(layout.bars[0].a.x == layout.bars[0].b.x ? 8 : 6, layout.bar_count);
        for (unsigned i = 0; i < layout.bar_count; i += 2) {
            struct bar door = {layout.bars[i].b, layout.bars[i + 1].a};

            TEST_ASSERT_DOUBLE_WITHIN(100.0, 550.0, length(door));
            TEST_ASSERT_EQUAL_DOUBLE(0.0, fmin(layout.bars[i].a.x, layout.bars[i].a.y));
        }
    }
    TEST_ASSERT_TRUE(upright > 0 && upright < LAYOUTS);
}

TEST(corridors_of_a_huge_arena_are_limited_to_the_array)
{
    struct layout_params params = PARAMS;

    params.width_mm = params.height_mm = 1e6;
    draw_corridors(&draws, &params, &layout);
    TEST_ASSERT_EQUAL_UINT32(LAYOUT_BARS_MAX, layout.bar_count);
}

TEST(dead_ends_are_pockets_open_on_one_side)
{
    for (unsigned n = 0; n < LAYOUTS; n++) {
        draw_dead_ends(&draws, &PARAMS, &layout);
        TEST_ASSERT_EQUAL_UINT32(12, layout.bar_count);
        expect_inside(20.0);
        for (unsigned i = 0; i < 12; i += 3) {
            TEST_ASSERT_DOUBLE_WITHIN(110.0, 490.0, length(layout.bars[i]));
            TEST_ASSERT_DOUBLE_WITHIN(200.0, 600.0, length(layout.bars[i + 1]));
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, length(layout.bars[i + 1]), length(layout.bars[i + 2]));
            TEST_ASSERT_EQUAL_DOUBLE(layout.bars[i].a.x, layout.bars[i + 1].a.x);
            TEST_ASSERT_EQUAL_DOUBLE(layout.bars[i].b.x, layout.bars[i + 2].a.x);
        }
    }
}

static void draw_written_world(void)
{
    struct layout_kind kind = {.style = LAYOUT_WRITTEN, .params = PARAMS, .written = &written};

    draw_written(&draws, &kind, &reach, &layout);
}

TEST(written_bars_and_food_are_laid_out)
{
    draw_written_world();
    TEST_ASSERT_EQUAL_UINT32(1, layout.bar_count);
    TEST_ASSERT_EQUAL_UINT32(1, layout.food_count);
    TEST_ASSERT_EQUAL_DOUBLE(2000.0, layout.bars[0].a.x);
    TEST_ASSERT_EQUAL_DOUBLE(3000.0, layout.bars[0].b.y);
    TEST_ASSERT_EQUAL_DOUBLE(500.0, layout.food[0].x);
}

TEST(written_start_has_its_heading_in_degrees)
{
    written.start = (struct written_entry){3, {700.0, 800.0, 450.0}};
    draw_written_world();
    TEST_ASSERT_EQUAL_DOUBLE(700.0, start.at.x);
    TEST_ASSERT_EQUAL_DOUBLE(800.0, start.at.y);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, DRAW_PI / 2, start.heading_rad);
}

TEST(missing_start_is_drawn_within_reach_of_food)
{
    double least = 4000.0, most = 0.0;

    for (unsigned n = 0; n < LAYOUTS; n++) {
        draw_written_world();
        TEST_ASSERT_TRUE(start.at.x >= 160.0 && start.at.x <= 1820.0);   /* on its side of the bar */
        TEST_ASSERT_TRUE(start.at.y >= 160.0 && start.at.y <= 2840.0);
        least = fmin(least, start.at.x);
        most = fmax(most, start.at.x);
    }
    TEST_ASSERT_TRUE(least < 500.0 && most > 1500.0);
}

TEST(start_falls_on_the_food_when_no_other_cell_is_free)
{
    struct layout_params params = PARAMS;
    struct layout_kind kind = {.style = LAYOUT_WRITTEN, .params = params, .written = &written};

    kind.params.width_mm = kind.params.height_mm = 320.0;
    written.bar_count = 0;
    written.food[0] = (struct written_entry){2, {160.0, 160.0}};
    draw_written(&draws, &kind, &reach, &layout);
    TEST_ASSERT_EQUAL_DOUBLE(160.0, start.at.x);
    TEST_ASSERT_EQUAL_DOUBLE(160.0, start.at.y);
}
