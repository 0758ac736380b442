/* Sine and cosine: known answers. */
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
        TEST_ASSERT_DOUBLE_WITHIN(1e-16, known[i].sin, trig_sin(known[i].angle_rad));
        TEST_ASSERT_DOUBLE_WITHIN(1e-16, known[i].cos, trig_cos(known[i].angle_rad));
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
