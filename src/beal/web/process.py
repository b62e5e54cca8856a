"""The way from the server into the processes that answer, which alone import what computes."""

from anyio import CapacityLimiter, to_process


async def asked(name: str, body: bytes, limiter: CapacityLimiter | None = None) -> tuple[int, bytes]:
    """The status of an answer and the answer, from a process of its own.

    Parameters
    ----------
    name : str
        Of the question.
    body : bytes
        The question as JSON.
    limiter : CapacityLimiter, optional

    Returns
    -------
    status : int
    answer : bytes

    Raises
    ------
    BrokenWorkerProcess
        If the process was ended.
    """
    return await to_process.run_sync(_answered, name, body, cancellable=True, limiter=limiter)


def _answered(name: str, body: bytes) -> tuple[int, bytes]:
    from beal.web.worker import answered

    return answered(name, body)
