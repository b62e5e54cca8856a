"""Formulas as MathML, which browsers draw by themselves: no script, no font to load, no network."""

from docutils import nodes
from latex2mathml.converter import convert
from sphinx.application import Sphinx
from sphinx.errors import SphinxError

PRIMES = {
    "''": "\N{DOUBLE PRIME}",
    "'": "\N{PRIME}",
}  # raised in themselves; as superscripts of superscripts they would vanish


def mathml(formula: str, display: str) -> str:
    for ascii_form, prime in PRIMES.items():
        formula = formula.replace(ascii_form, prime)
    drawn: str = convert(formula, display=display)
    if "\\" in drawn:
        raise SphinxError(f"a formula with a command that would be printed as it is: {formula}")
    return drawn


def _inline(writer, node: nodes.math) -> None:
    writer.body.append(mathml(node.astext(), "inline"))
    raise nodes.SkipNode


def _display(writer, node: nodes.math_block) -> None:
    anchor = f' id="{node["ids"][0]}"' if node["ids"] else ""
    writer.body.append(f'<div class="math"{anchor}>{mathml(node.astext(), "block")}</div>\n')
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, bool]:
    app.add_html_math_renderer("mathml", inline_renderers=(_inline, None), block_renderers=(_display, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
