"""What a page is told of a run: what is new, and only that."""

from host_sim.live.feed import PageFeed
from host_sim.live.page_commands import FULL_SPEED


def test_a_page_is_told_what_is_new_and_only_that(live):
    run = live(speed=FULL_SPEED)
    feed = PageFeed(run)
    assert feed.next() is not None
    assert feed.next() is None
    run.simulation.step()
    assert "environment" not in feed.next()


def test_a_page_that_asks_seldom_gets_no_more_than_one_that_asks_often(live):
    run = live(speed=FULL_SPEED)
    feed = PageFeed(run)
    while run.simulation.tick < 20_000:
        if run.simulation.over:
            run.simulation.enter(2)
        run.simulation.step()
    assert len(feed.next()) < 50_000
