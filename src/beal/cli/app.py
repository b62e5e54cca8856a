"""The commands, gathered."""

from collections.abc import Callable
from typing import Annotated

import typer

from beal import __version__
from beal.cli.amplitude import amplitude
from beal.cli.control import control
from beal.cli.convert import convert
from beal.cli.critical import critical
from beal.cli.curve import curve
from beal.cli.design import design
from beal.cli.explore import explore
from beal.cli.flight import flight
from beal.cli.floquet import floquet
from beal.cli.maps import map_study, reproduce
from beal.cli.models import check, example
from beal.cli.modes import modes
from beal.cli.motion import response
from beal.cli.sensitivity import sensitivity
from beal.cli.uncertainty import uncertainty
from beal.cli.verify import verify

COMMANDS: dict[str, tuple[Callable[..., None], str]] = {
    "check": (check, "beal check tsto.toml"),
    "modes": (modes, "beal modes tsto.toml --count 4 --thrust 90"),
    "critical": (critical, "beal critical tsto.toml --all --json"),
    "curve": (curve, "beal curve tsto.toml --to 150 -o curve.csv"),
    "flight": (flight, "beal flight launcher.toml --figure flight.png"),
    "control": (control, "beal control launcher.toml --thrust 90 --json"),
    "floquet": (floquet, "beal floquet tsto.toml --thrust 50 --amplitude 5 --angular-frequency 30"),
    "explore": (explore, "beal explore tsto.toml"),
    "sensitivity": (sensitivity, "beal sensitivity tsto.toml --figure tornado.png"),
    "design": (design, "beal design study.toml --report design.html"),
    "map": (map_study, "beal map study.toml -o map.zarr"),
    "uncertainty": (uncertainty, "beal uncertainty study.toml --indices 1024 --figure scatter.png"),
    "response": (response, "beal response tsto.toml --duration 10 --initial mode:1:0.01"),
    "amplitude": (amplitude, "beal amplitude tsto.toml --duration 4 --thrust 10:120:45 --force 0:2:21"),
    "reproduce": (reproduce, "beal reproduce -o paper"),
    "verify": (verify, "beal verify --case pflueger"),
    "convert": (convert, "beal convert stick.bdf tsto.toml --nose low"),
    "example": (example, "beal example tsto -o tsto.toml"),
}

app = typer.Typer(
    help="Critical thrust of flexible launch vehicles: where they fail, how, and what joint keeps them safe.",
    epilog="Start with: beal example tsto -o tsto.toml, then beal critical tsto.toml",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)
for name, (command, line) in COMMANDS.items():
    app.command(name, epilog=f"Example: {line}")(command)


def _version(asked: bool) -> None:
    if asked:
        print(f"beal {__version__}")
        raise typer.Exit


@app.callback()
def _beal(
    version: Annotated[bool, typer.Option("--version", callback=_version, is_eager=True, help="The version.")] = False,
) -> None:
    pass
