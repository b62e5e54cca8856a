"""What the server lets in: requests of its own page, from this machine, of a bounded size."""

from urllib.parse import urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.requests import Request
from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

HOSTS = ("127.0.0.1", "localhost")
LARGEST = 6_000_000  # bytes of a request
POLICY = (
    "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
ANSWERED = {
    "Content-Security-Policy": POLICY,
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-cache",
}


class TooLarge(ValueError):
    """A request with more bytes than are taken."""


class Guard:
    """Refuses requests under another name than this machine's own, and from other pages than the explorer.

    A page on the internet may send requests to this machine: its name for us (DNS rebinding) or its own origin
    gives it away.

    Parameters
    ----------
    app : ASGI application
    """

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answers a request."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return

        async def marked(message: Message) -> None:
            if message["type"] == "http.response.start":
                MutableHeaders(scope=message).update(ANSWERED)
            await send(message)

        wrong = refusal(Headers(scope=scope))
        await (JSONResponse(errors(wrong), status_code=403) if wrong else self._app)(scope, receive, marked)


def refusal(headers: Headers) -> str:
    """Why a request is not taken; empty where it is.

    Examples
    --------
    >>> refusal(Headers({"host": "127.0.0.1:8000"}))
    ''
    >>> refusal(Headers({"host": "127.0.0.1:8000", "origin": "https://example.org"}))
    "must come from the explorer's own page, found https://example.org"
    """
    host, origin = headers.get("host", ""), headers.get("origin")
    if _name(host) not in HOSTS:
        return f"must be asked for as {' or '.join(HOSTS)}, found {host[:80] or 'no host'}"
    if origin is not None and origin != f"http://{host}":
        return f"must come from the explorer's own page, found {origin[:80]}"
    return ""


def _name(host: str) -> str:
    try:
        return urlsplit(f"//{host}").hostname or ""
    except ValueError:
        return ""


def errors(message: str, path: str = "") -> dict[str, list[dict[str, str]]]:
    """The one form of every refusal."""
    return {"errors": [{"path": path, "message": message}]}


async def body_of(request: Request) -> bytes:
    """The whole body of a request.

    Raises
    ------
    TooLarge
        As soon as it is.
    """
    body = bytearray()
    async for part in request.stream():
        body += part
        if len(body) > LARGEST:
            raise TooLarge(f"must be at most {LARGEST // 10**6} MB")
    return bytes(body)
