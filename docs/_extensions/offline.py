"""The built pages ask nothing of a network: scripts, styles, fonts and pictures lie beside them, or the build fails."""

import re
from pathlib import Path

from sphinx.application import Sphinx
from sphinx.errors import SphinxError

FETCHED = re.compile(
    r"""<(?:script|link|img|iframe|source)\b[^>]*?\b(?:src|href)=["']?((?:https?:)?//[^"'\s>]+)"""
    r"""|(?:url\(|@import\s+)["']?((?:https?:)?//[^"')\s]+)"""
)


def fetched(text: str) -> list[str]:
    """Addresses that a browser would load by itself to show the page; links to follow are none."""
    return [html or css for html, css in FETCHED.findall(text)]


def check(app: Sphinx, error: Exception | None) -> None:
    pages = [path for kind in ("*.html", "*.css") for path in Path(app.outdir).rglob(kind)] if error is None else []
    found = [f"{path.name}: {address}" for path in pages for address in fetched(path.read_text(encoding="utf-8"))]
    if found:
        raise SphinxError("these pages ask a network: " + ", ".join(found))


def setup(app: Sphinx) -> dict[str, bool]:
    app.connect("build-finished", check)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
