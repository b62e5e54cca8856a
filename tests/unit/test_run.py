"""Tasks on workers: lazily drawn, bounded in flight, none lost."""

import os
import signal
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from functools import partial

import numpy as np
import pytest

import beal
from beal.study.run import Processes, run, workers_for
from beal.study.study import Solve, Study

VEHICLE = beal.catalog.tsto(0.6, 5000.0, 5000.0)
SPRINGS = {
    "joint[0].rotational_stiffness": tuple(np.linspace(1, 2, 400)),
    "joint[0].shear_stiffness": tuple(np.linspace(1, 2, 400)),
}
OTHERS = {"stage.split": tuple(np.linspace(0.2, 0.8, 400))}


class Slow(Executor):
    """Does what it was handed only when it is asked for more than it may hold."""

    def __init__(self, most):
        self.most, self.held, self.largest = most, [], 0

    def submit(self, work, *arguments):
        future = Future()
        self.held.append((future, work, arguments))
        self.largest = max(self.largest, len(self.held))
        if len(self.held) == self.most:
            self.finish()
        return future

    def finish(self):
        for future, work, arguments in self.held:
            future.set_result(work(*arguments))
        self.held.clear()


def square(number):
    return number * number


def die_once(folder, number):
    """Kills its process the first time that it comes to a number."""
    mark = folder / str(number)
    if number % 5 == 0 and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return number * number


def die(number):
    os.kill(os.getpid(), signal.SIGKILL)


def test_work_in_flight_is_bounded_and_drawn_as_needed():
    kept, drawn = {}, []

    def tasks():
        for number in range(100):
            drawn.append(number)
            assert len(drawn) - len(kept) <= 10
            yield number

    executor = Slow(10)
    run(tasks(), square, kept.__setitem__, executor, in_flight=10)
    assert kept == {n: n * n for n in range(100)}
    assert executor.largest == 10


@pytest.mark.parametrize("make", [lambda: None, lambda: ThreadPoolExecutor(2), lambda: Processes(2)])
def test_every_task_is_done_once(make):
    kept = []
    executor = make()
    run(range(50), square, lambda task, result: kept.append((task, result)), executor, in_flight=7)
    assert sorted(kept) == [(n, n * n) for n in range(50)]
    if executor:
        executor.shutdown()


def test_a_killed_worker_loses_no_task(tmp_path):
    kept = []
    with Processes(2) as executor:
        run(range(12), partial(die_once, tmp_path), lambda *pair: kept.append(pair), executor)
    assert sorted(kept) == [(n, n * n) for n in range(12)]


def test_workers_that_die_always_are_given_up():
    with Processes(2) as executor, pytest.raises(beal.ModelError, match=r"workers died.*--resume"):
        run(range(3), die, print, executor)


def test_a_foreign_pool_that_breaks_says_how_to_go_on():
    with ProcessPoolExecutor(1) as executor, pytest.raises(beal.ModelError, match="--resume"):
        run(range(3), die, print, executor)


def test_what_goes_wrong_in_a_worker_is_raised_and_the_rest_is_dropped():
    done = []
    with ThreadPoolExecutor(1) as executor, pytest.raises(ZeroDivisionError):
        run(range(100), lambda n: done.append(n) or 1 // (3 - n), lambda *pair: None, executor, in_flight=5)
    assert len(done) < 100


@pytest.mark.parametrize(
    ("axes", "options", "kind"),
    [
        (SPRINGS, {}, ThreadPoolExecutor),
        (OTHERS, {}, Processes),
        (OTHERS, {"points": 10}, type(None)),
        (OTHERS, {"points": 0}, type(None)),
    ],
)
def test_workers_suit_the_study(axes, options, kind):
    with workers_for(Study(VEHICLE, axes, Solve()), 2, **options) as executor:
        assert type(executor) is kind


def test_one_worker_is_this_process():
    with workers_for(Study(VEHICLE, SPRINGS, Solve()), 1) as executor:
        assert executor is None
