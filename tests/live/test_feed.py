"""What a page is told of a run: what is new, and only that."""

from types import SimpleNamespace

from host_sim.live.board_feed import BoardFeed, Class
from host_sim.live.feed import PageFeed
from host_sim.live.page_commands import FULL_SPEED
from host_sim.live.seats import Rights, Seats


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


def test_nobody_is_told_what_a_page_is_recognised_by(live):
    run, seats, key = live(robots=2), Seats([1, 2]), "0123456789abcdef" * 2
    seat = seats.take(key)
    listener = SimpleNamespace(short_urls=["octet/mint-4711"], qr_modules=[])

    said = [PageFeed(run, rights=Rights(seats, seat)).next(), BoardFeed(run, of=Class(run, listener, seats)).next()]

    assert all(text and "node" in text for text in said)
    assert not any(key in text for text in said)
