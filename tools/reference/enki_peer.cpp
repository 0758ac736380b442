// enki_peer TICKS WIDTH HEIGHT X Y HEADING [AX AY BX BY]...: Enki, a fast simulator of robots, at the arena's work.
//
// A disc with five proximity sensors among bars, 20 ms a tick, without a picture; it goes ahead, and turns where a
// sensor in front sees something. Sizes are in mm, the heading in rad. Prints the processor time that the ticks took,
// in s. host_sim/lab/bench/peer_figures.py builds and calls it.
#include <enki/PhysicalEngine.h>
#include <enki/interactions/IRSensor.h>
#include <enki/robots/DifferentialWheeled.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <vector>

namespace {

const double CM_PER_MM = 0.1, TICK_S = 0.02, SPEED_CM_S = 20.0;
const double BODY_RADIUS_CM = 10.0, WHEEL_TRACK_CM = 16.0, REACH_CM = 6.0, BAR_CM = 4.0, HEIGHT_CM = 5.0;
const double STEP_RAD = M_PI / 4;
const int SENSORS = 5, FRONT = 2;

struct Peer : public Enki::DifferentialWheeled {
    std::vector<std::unique_ptr<Enki::IRSensor>> sensors;

    Peer() : DifferentialWheeled(WHEEL_TRACK_CM, 50.0, 0.0)
    {
        for (int i = -FRONT; i <= FRONT; i++) {
            Enki::Vector place(BODY_RADIUS_CM * std::cos(i * STEP_RAD), BODY_RADIUS_CM * std::sin(i * STEP_RAD));

            sensors.emplace_back(
                new Enki::IRSensor(this, place, HEIGHT_CM / 2, i * STEP_RAD, REACH_CM, 3731.0, 0.3, 7.0));
            addLocalInteraction(sensors.back().get());
        }
        setCylindric(BODY_RADIUS_CM, HEIGHT_CM, 1.0);
    }

    bool sees(int i) const { return sensors[i]->getValue() > 0.0; }

    void decide()
    {
        bool turns_right = sees(FRONT + 1) || sees(FRONT), turns_left = !turns_right && sees(FRONT - 1);

        leftSpeed = turns_left ? -SPEED_CM_S : SPEED_CM_S;
        rightSpeed = turns_right ? -SPEED_CM_S : SPEED_CM_S;
    }
};

void add_bar(Enki::World &world, char **numbers)
{
    double ax = std::atof(numbers[0]), ay = std::atof(numbers[1]);
    double bx = std::atof(numbers[2]), by = std::atof(numbers[3]);
    Enki::PhysicalObject *bar = new Enki::PhysicalObject;   // the world deletes it

    bar->setRectangular(std::hypot(bx - ax, by - ay) * CM_PER_MM + BAR_CM, BAR_CM, 2 * HEIGHT_CM, -1.0);
    bar->pos = Enki::Point((ax + bx) / 2 * CM_PER_MM, (ay + by) / 2 * CM_PER_MM);
    bar->angle = std::atan2(by - ay, bx - ax);
    world.addObject(bar);
}

}   // namespace

int main(int count, char **words)
{
    if (count < 7 || (count - 7) % 4) {
        std::fprintf(stderr, "usage: %s TICKS WIDTH HEIGHT X Y HEADING [AX AY BX BY]...\n", words[0]);
        return 2;
    }
    Enki::World world(std::atof(words[2]) * CM_PER_MM, std::atof(words[3]) * CM_PER_MM);
    Peer *robot = new Peer;   // the world deletes it

    for (int i = 7; i < count; i += 4)
        add_bar(world, words + i);
    robot->pos = Enki::Point(std::atof(words[4]) * CM_PER_MM, std::atof(words[5]) * CM_PER_MM);
    robot->angle = std::atof(words[6]);
    world.addObject(robot);
    std::clock_t began = std::clock();

    for (long tick = 0; tick < std::atol(words[1]); tick++) {
        world.step(TICK_S);
        robot->decide();
    }
    std::printf("%.9f\n", double(std::clock() - began) / CLOCKS_PER_SEC);
    std::fprintf(stderr, "ends at %.0f, %.0f mm\n", robot->pos.x / CM_PER_MM, robot->pos.y / CM_PER_MM);
    return 0;
}
