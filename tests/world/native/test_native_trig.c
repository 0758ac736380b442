/* Sine, cosine and distance: known answers, to the last bit. */
#include <string.h>

#include "host_sim/world/native/trig.h"
#include "tests/test.h"

static const double TURN_RAD = 6.283185307179586;

TEST(known_angles_have_known_sines_and_cosines)
{
    static const struct {
        double angle_rad, sin, cos;
    } known[] = {
        {0.0, 0.0, 1.0}, {0.5, 0.479425538604203, 0.8775825618903728}, {1.0, 0.8414709848078965, 0.5403023058681398},
        {2.0, 0.9092974268256817, -0.4161468365471424}, {-3.0, -0.1411200080598672, -0.9899924966004454},
        {100.0, -0.5063656411097588, 0.8623188722876839}, {1e6, -0.34999350217129294, 0.9367521275331447},
    };

    for (unsigned i = 0; i < sizeof known / sizeof *known; i++) {
        TEST_ASSERT_DOUBLE_WITHIN(2.3e-16, known[i].sin, trig_sin(known[i].angle_rad));
        TEST_ASSERT_DOUBLE_WITHIN(2.3e-16, known[i].cos, trig_cos(known[i].angle_rad));
    }
}

TEST(they_belong_to_one_circle)
{
    for (int i = -1000; i <= 1000; i++) {
        double angle_rad = i * TURN_RAD / 360.0;
        double sin = trig_sin(angle_rad), cos = trig_cos(angle_rad);

        TEST_ASSERT_DOUBLE_WITHIN(1e-15, 1.0, sin * sin + cos * cos);
        TEST_ASSERT_TRUE(trig_sin(-angle_rad) == -sin);
        TEST_ASSERT_TRUE(trig_cos(-angle_rad) == cos);
    }
}

static uint64_t digest_with(uint64_t digest, double value)
{
    uint64_t bits;

    memcpy(&bits, &value, sizeof bits);
    return (digest ^ bits) * 1099511628211u;
}

/* This number was computed with gcc and glibc on x86-64; every compiler, library and processor has to give it. */
TEST(a_hundred_thousand_angles_have_the_same_bits_everywhere)
{
    uint64_t digest = 14695981039346656037u;

    for (int i = -50000; i < 50000; i++) {
        digest = digest_with(digest, trig_sin(i / 1024.0));
        digest = digest_with(digest, trig_cos(i / 1024.0));
        digest = digest_with(digest, trig_hypot(i / 1024.0, 12.5));
    }
    TEST_ASSERT_EQUAL_HEX64(0xB5258719B6ABC89B, digest);
}
