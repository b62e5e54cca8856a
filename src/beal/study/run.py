"""Many tasks on the workers there are: bounded in number at any time, and none lost with a worker."""

import math
import multiprocessing
import os
import signal
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    Executor,
    Future,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
    wait,
)
from contextlib import contextmanager
from itertools import islice
from multiprocessing.connection import wait as wait_for
from threading import Thread
from typing import Any, ParamSpec, TypeVar

from beal.errors import ModelError
from beal.stability.threads import one_thread
from beal.study.blocks import seconds, together
from beal.study.study import Study

T = TypeVar("T")
R = TypeVar("R")
P = ParamSpec("P")

IN_FLIGHT = 1024  # tasks handed over and not yet kept: enough for a cluster, little for the memory
RESTARTS = 3  # of workers that died, without a task done between
DIED = "workers died again and again, perhaps for want of memory; try fewer; a map on disk goes on with --resume"
SMALL = 1.0  # seconds of work up to which starting processes costs more than it saves


class Processes(Executor):
    """Worker processes that can be started again after one was killed.

    Parameters
    ----------
    workers : int
    """

    def __init__(self, workers: int) -> None:
        self.workers = workers
        self._pool = _pool(workers)

    def submit(self, task: Callable[P, R], /, *arguments: P.args, **options: P.kwargs) -> Future[R]:
        """Hands over one call."""
        return self._pool.submit(task, *arguments, **options)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Ends the processes when what they have begun is done."""
        self._pool.shutdown(wait, cancel_futures=cancel_futures)

    def restart(self) -> None:
        """New processes in place of those that broke."""
        self._pool.shutdown()
        self._pool = _pool(self.workers)


def cores() -> int:
    """Cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@contextmanager
def workers_for(study: Study, workers: int | None = None, points: int | None = None) -> Iterator[Executor | None]:
    """The executor that suits a study on this machine.

    Threads where points are solved together by a kernel that needs no interpreter lock, processes where each is built
    by itself in Python, neither for a small job.

    Parameters
    ----------
    study : Study
    workers : int, optional
        By default one for each core.
    points : int, optional
        How many are to be solved, by default all of the grid.

    Yields
    ------
    Executor or None

    Raises
    ------
    ModelError
        If the number of workers is not positive.
    """
    if workers is not None and workers < 1:
        raise ModelError(f"workers: must be at least 1, found {workers}")
    number = workers or cores()
    share = 1.0 if points is None else points / math.prod(study.shape)
    if number == 1 or share == 0:
        yield None
    elif together(study):
        with one_thread(), ThreadPoolExecutor(number) as threads:
            yield threads
    elif share * seconds(study) > SMALL:
        with Processes(number) as processes:
            yield processes
    else:
        yield None


def run(
    tasks: Iterable[T],
    work: Callable[[T], R],
    keep: Callable[[T, R], None],
    executor: Executor | None = None,
    in_flight: int = IN_FLIGHT,
) -> None:
    """Does all tasks, here or in an executor's workers.

    Parameters
    ----------
    tasks : iterable
        Drawn as they are needed.
    work : callable
        Makes a result of a task; for other processes it must be a function of a module, a `functools.partial` of one
        or the like.
    keep : callable
        Takes a task and its result, in this thread, in the order of completion.
    executor : Executor, optional
    in_flight : int, optional
        Tasks handed over and not yet kept, at most.

    Raises
    ------
    ModelError
        If workers die again and again.

    Examples
    --------
    >>> squares = {}
    >>> run(range(4), lambda n: n * n, squares.__setitem__)
    >>> squares
    {0: 0, 1: 1, 2: 4, 3: 9}
    """
    if executor is None:
        for task in tasks:
            keep(task, work(task))
        return
    source, ready, waiting, broken = iter(tasks), deque[T](), dict[Future[R], T](), 0
    try:
        while True:
            try:
                _hand_over(source, ready, waiting, in_flight, lambda task: executor.submit(work, task))
                if not waiting:
                    return
                for future in wait(waiting, return_when=FIRST_COMPLETED).done:
                    result = future.result()
                    keep(waiting.pop(future), result)
                    broken = 0
            except BrokenExecutor:
                if not isinstance(executor, Processes) or broken == RESTARTS:
                    raise ModelError(DIED) from None
                broken += 1
                ready.extend(waiting.values())
                waiting.clear()
                executor.restart()
    finally:
        for future in waiting:
            future.cancel()


def _hand_over(
    source: Iterator[T],
    ready: deque[T],
    waiting: dict[Future[R], T],
    most: int,
    submit: Callable[[T], Future[R]],
) -> None:
    """Fills up what is in flight; a task stays ready until the executor has taken it."""
    while len(waiting) < most:
        if not ready:
            ready.extend(islice(source, 1))
        if not ready:
            return
        future = submit(ready[0])
        waiting[future] = ready.popleft()


def _pool(workers: int) -> ProcessPoolExecutor:
    fork = "fork" in multiprocessing.get_all_start_methods()  # a script need not guard its main module
    context = multiprocessing.get_context("fork" if fork else None)
    return ProcessPoolExecutor(workers, mp_context=context, initializer=_begin)


def _begin() -> None:
    """In a worker: Ctrl-C, which reaches the whole process group, is for the parent; without a parent it ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent: Any = multiprocessing.parent_process()
    Thread(target=_end_with, args=(parent.sentinel,), daemon=True).start()


def _end_with(sentinel: int) -> None:
    wait_for([sentinel])
    os._exit(1)
