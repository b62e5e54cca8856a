"""Two line drawings: the vehicle, and the forces on a joint that slides."""

_STYLE = (
    "<style>text{font:15px 'DejaVu Sans',sans-serif}.l{stroke:#000;stroke-width:1.6;fill:none}"
    ".b{stroke:#000;stroke-width:1.4;fill:#dfe9f1}.t{stroke:#d55e00;stroke-width:2.2;fill:none}.d{stroke:#777;stroke-width:1;"
    "stroke-dasharray:4 4;fill:none}.r{fill:#d55e00}.k{fill:#000}</style>"
)


def _arrow(x1: float, y1: float, x2: float, y2: float, look: str = "t", head: str = "r") -> str:
    """A straight arrow."""
    dx, dy = x2 - x1, y2 - y1
    length = (dx * dx + dy * dy) ** 0.5
    ux, uy = dx / length, dy / length
    bx, by = x2 - 11 * ux, y2 - 11 * uy
    points = f"{x2:.1f},{y2:.1f} {bx - 4.5 * uy:.1f},{by + 4.5 * ux:.1f} {bx + 4.5 * uy:.1f},{by - 4.5 * ux:.1f}"
    return f'<path class="{look}" d="M{x1:.1f} {y1:.1f}L{bx:.1f} {by:.1f}"/><polygon class="{head}" points="{points}"/>'


def _svg(width: int, height: int, label: str, *parts: str) -> str:
    return f'<svg viewBox="0 0 {width} {height}" role="img" aria-label="{label}">{_STYLE}{"".join(parts)}</svg>'


def vehicle() -> str:
    """Fig. 1: two stages, their joint, the sensor, thrust and transverse force.

    Returns
    -------
    str
        An ``svg`` element.
    """
    coil = "M442 92l5 0 4 -9 8 18 8 -18 8 18 4 -9 5 0"
    return _svg(
        860,
        190,
        "Two beams joined by a rotational and a shear spring, follower thrust at the tail",
        '<rect class="b" x="60" y="82" width="380" height="20" rx="2"/>',
        '<rect class="b" x="486" y="82" width="250" height="20" rx="2"/>',
        f'<path class="l" d="{coil}"/><path class="l" d="M450 74a15 15 0 0 1 28 0"/>',
        '<text x="464" y="52" text-anchor="middle">k<tspan dy="4" font-size="11">r</tspan><tspan dy="-4">, k</tspan>'
        '<tspan dy="4" font-size="11">s</tspan></text>',
        '<text x="250" y="72" text-anchor="middle">upper stage</text>',
        '<text x="611" y="72" text-anchor="middle">lower stage</text>',
        '<circle class="k" cx="136" cy="92" r="5"/><text x="136" y="128" text-anchor="middle">IMU</text>',
        '<path class="d" d="M60 110V168M464 110V168M736 110V168"/>',
        _arrow(110, 160, 62, 160, "l", "k"),
        _arrow(110, 160, 462, 160, "l", "k"),
        _arrow(560, 160, 466, 160, "l", "k"),
        _arrow(560, 160, 734, 160, "l", "k"),
        '<text x="262" y="153" text-anchor="middle">L<tspan dy="4" font-size="11">1</tspan></text>'
        '<text x="600" y="153" text-anchor="middle">L \N{MINUS SIGN} L<tspan dy="4" font-size="11">1</tspan></text>',
        _arrow(832, 92, 740, 92),
        '<text x="800" y="80" text-anchor="middle">P</text>',
        _arrow(736, 22, 736, 80),
        '<text x="752" y="34">F(t)</text><text x="26" y="97" text-anchor="middle">nose</text>',
    )


def couple() -> str:
    """A joint that has slid by d: the axial force acts on two faces that are offset.

    Returns
    -------
    str
        An ``svg`` element.
    """
    return _svg(
        860,
        210,
        "Two faces of a joint offset by d, with the axial force N on each",
        '<rect class="b" x="120" y="60" width="280" height="34"/>',
        '<rect class="b" x="440" y="118" width="280" height="34"/>',
        '<path class="d" d="M60 77H430M410 135H790"/>',
        _arrow(40, 77, 116, 77),
        _arrow(822, 135, 724, 135),
        '<text x="70" y="65" text-anchor="middle">N</text>',
        '<text x="782" y="123" text-anchor="middle">N</text>',
        '<path class="l" d="M420 77V135"/>',
        '<text x="404" y="112" text-anchor="end">d = [[y]]</text>',
        '<path class="l" d="M520 40a60 60 0 0 1 44 50"/><polygon class="k" points="566,100 557,87 570,85"/>',
        '<text x="580" y="66">couple N d: who balances it?</text>',
        '<text x="250" y="196" text-anchor="middle">forward face</text>',
        '<text x="580" y="196" text-anchor="middle">aft face</text>',
    )
