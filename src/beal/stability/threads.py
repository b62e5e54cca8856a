"""One thread of linear algebra: small matrices are slower on two."""

from contextlib import AbstractContextManager
from functools import cache

from threadpoolctl import ThreadpoolController


@cache
def _controller() -> ThreadpoolController:
    return ThreadpoolController()


def one_thread() -> AbstractContextManager[object]:
    """A context in which the linear algebra libraries run on one thread."""
    return _controller().limit(limits=1, user_api="blas")
