"""What the page shows, as lines to take away: the model, a Python script, commands."""


def python_lines(text: str, formulation: str, to: float | None, points: int, modes: int) -> str:
    """A script that finds the critical thrust and the curves of a model.

    Parameters
    ----------
    text : str
        The model (TOML).
    formulation : str
    to : float or None
        Last thrust of the curves.
    points, modes : int

    Returns
    -------
    str
    """
    model = text.replace("\\", "\\\\").replace('"""', '\\"\\"\\"')
    how = "" if formulation == "objective" else f", formulation={formulation!r}"
    return f'''import beal

vehicle = beal.loads("""
{model}""")
found = beal.critical_thrust(vehicle{how})
print(found.kind, found.modes, found.critical_thrust)
curve = beal.thrust_curve(vehicle, to={to!r}, points={points}, modes={modes}{how})
print(curve.thrust[-1], curve.angular_frequency[-1])
'''


def command_lines(text: str, formulation: str, to: float | None, points: int, modes: int) -> str:
    """Commands for a shell that write the model and find its critical thrust and curves."""
    how = "" if formulation == "objective" else f" --formulation {formulation}"
    end = "END_OF_MODEL"
    lines = [f"cat > vehicle.toml <<'{end}'", f"{text}{end}", f"beal critical vehicle.toml{how}"]
    if to:
        lines.append(f"beal curve vehicle.toml --to {to!r} --points {points} --modes {modes}{how}")
    return "\n".join(lines) + "\n"
