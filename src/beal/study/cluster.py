"""Workers on other machines, by dask.distributed."""

import logging
import re
from collections.abc import Iterator
from concurrent.futures import CancelledError, Executor
from contextlib import contextmanager
from importlib import metadata
from typing import TYPE_CHECKING

from beal.errors import ModelError
from beal.study.run import cores

if TYPE_CHECKING:
    from distributed import Client

PATIENCE = 10.0  # seconds for the scheduler to answer, and for its first worker
DEAF = "import signal\nsignal.signal(signal.SIGINT, signal.SIG_IGN)"  # Ctrl-C is for the parent, as with `Processes`
_ADDRESS = re.compile(r"(\w+://)?[^\s/:]+:\d+")


@contextmanager
def cluster(scheduler: str, workers: int | None = None) -> Iterator[Executor]:
    """The workers of a dask cluster as an executor.

    Parameters
    ----------
    scheduler : str
        ``tcp://host:port``, or ``local`` for a cluster on this machine that lives as long as the context.
    workers : int, optional
        Processes of a local cluster, by default one for each core.

    Yields
    ------
    Executor

    Raises
    ------
    ModelError
        If dask is missing, the scheduler does not answer or has no workers, or they have another version of beal; or if
        the cluster is lost.
    """
    if scheduler != "local" and not _ADDRESS.fullmatch(scheduler):
        raise ModelError(f"--scheduler: must be local or an address such as tcp://host:8786, found {scheduler!r}")
    if scheduler != "local" and workers is not None:
        raise ModelError("--workers: a scheduler has its own workers; leave one of the two out")
    try:
        from distributed import Client, KilledWorker, LocalCluster
    except ModuleNotFoundError as error:
        if error.name not in ("distributed", "dask"):
            raise
        raise ModelError("--scheduler: needs dask.distributed, which is not installed; install beal[cluster]") from None
    try:
        if scheduler == "local":
            quiet = {"dashboard_address": None, "silence_logs": logging.CRITICAL, "preload": [DEAF]}
            with LocalCluster(workers or cores(), threads_per_worker=1, **quiet) as here, Client(here) as client:
                yield _executor(client)
        else:
            with _client(scheduler) as client:
                yield _executor(client)
    except KilledWorker as error:
        reason = "a block lost its worker several times, perhaps for want of memory"
        raise ModelError(f"{scheduler}: {reason}; what was solved before is kept, go on with --resume") from error
    except CancelledError as error:
        raise ModelError(f"{scheduler}: lost; what was solved before is kept, go on with --resume") from error


def _client(scheduler: str) -> "Client":
    from distributed import Client

    try:
        return Client(scheduler, timeout=PATIENCE)
    except OSError:  # a time limit is one too
        raise ModelError(f"--scheduler: none answers at {scheduler} within {PATIENCE:g} s; is it running?") from None


def _executor(client: "Client") -> Executor:
    """The client's workers, when there is one at least and all have this version."""
    try:
        client.wait_for_workers(1, timeout=PATIENCE)
    except TimeoutError:
        raise ModelError(f"--scheduler: has no workers, and got none within {PATIENCE:g} s; start some") from None
    here = metadata.version("beal")
    found = client.run(metadata.version, "beal", on_error="return")
    others = [(address, _version(version)) for address, version in sorted(found.items()) if version != here]
    if others:
        raise ModelError([("--scheduler", f"its workers need beal {here}"), *others])
    return client.get_executor()


def _version(found: object) -> str:
    return f"has beal {found}" if isinstance(found, str) else "has no beal"
