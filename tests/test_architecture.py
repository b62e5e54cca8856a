"""The house rules that a parser can see: who imports whom, how long a module is, what it never does."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

SOURCE = Path(__file__).parents[1] / "src"
MODULES = sorted((SOURCE / "beal").rglob("*.py"))
# In the order in which data flow: a room imports only from itself and from rooms before it.
ROOMS = [
    "errors",
    "units",
    "vehicle",
    "discretisation",
    "stability",
    "motion",
    "control",
    "interop",
    "study",
    "design",
    "verification",
    "plot",
    "report",
    "paper",
    "web",
    "cli",
]
LONGEST = 400
STORES_CODE = {"pickle", "cPickle", "cloudpickle", "dill", "joblib", "marshal", "shelve"}


def name_of(path: Path) -> str:
    return ".".join(path.relative_to(SOURCE).with_suffix("").parts).removesuffix(".__init__")


KNOWN = {name_of(path) for path in MODULES}
every_module = pytest.mark.parametrize("path", MODULES, ids=name_of)


def imported(tree: ast.AST, path: Path) -> Iterator[str]:
    """Every module that is imported anywhere in the tree, inside functions and under TYPE_CHECKING too."""
    package = name_of(path) if path.name == "__init__.py" else name_of(path.with_name("__init__.py"))
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = package.rsplit(".", node.level - 1)[0] if node.level else ""
            module = ".".join(filter(None, (base, node.module)))
            members = (f"{module}.{alias.name}" for alias in node.names)
            yield from (member if member in KNOWN else module for member in members)


def upward_imports(tree: ast.AST, path: Path) -> list[str]:
    """Imports against the flow; the package itself, which imports from all rooms, is last but the cli."""
    order = [*ROOMS[:-1], "", ROOMS[-1]]
    room = room_of(name_of(path))
    inside = (name for name in imported(tree, path) if name.split(".")[0] == "beal")
    return [name for name in inside if order.index(room_of(name)) > order.index(room)]


def room_of(name: str) -> str:
    return [*name.split("."), ""][1]


def forbidden(tree: ast.AST, path: Path) -> list[str]:
    """What no module does, each with its line."""
    found = [f"{name} is imported" for name in imported(tree, path) if name.split(".")[0] in STORES_CODE]
    for node in ast.walk(tree):
        match node:
            case ast.ExceptHandler(type=None):
                found.append(f"line {node.lineno}: bare except")
            case ast.ExceptHandler(type=kinds) if {"Exception", "BaseException"} & names_in(kinds):
                found.append(f"line {node.lineno}: catches every exception")
            case ast.Assert():
                found.append(f"line {node.lineno}: assert")
            case ast.Call(func=ast.Name(id="eval" | "exec" as name)):
                found.append(f"line {node.lineno}: {name}")
            case ast.Call(func=ast.Name(id="print")) if room_of(name_of(path)) != "cli":
                found.append(f"line {node.lineno}: print")
    return found


def names_in(tree: ast.AST | None) -> set[str]:
    return {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)} if tree else set()


def parsed(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


@every_module
def test_every_module_belongs_to_a_room(path):
    assert room_of(name_of(path)) in {"", *ROOMS}


@every_module
def test_a_room_imports_only_from_rooms_above_it(path):
    assert upward_imports(parsed(path), path) == []


@every_module
def test_modules_stay_short(path):
    assert len(path.read_text(encoding="utf-8").splitlines()) <= LONGEST


@every_module
def test_nothing_forbidden_is_done(path):
    assert forbidden(parsed(path), path) == []


@pytest.mark.parametrize(
    "code",
    [
        "import beal.stability",
        "import beal",
        "from beal import stability, load",
        "from beal.cli import main",
        "from ..stability import spectrum",
        "from .. import load",
        "def f():\n    import beal.study.grid",
        "if TYPE_CHECKING:\n    from beal.motion import Response",
    ],
)
def test_an_import_against_the_flow_is_seen(code, monkeypatch):
    monkeypatch.setitem(globals(), "KNOWN", KNOWN | {"beal.stability"})
    assert upward_imports(ast.parse(code), SOURCE / "beal/discretisation/somewhere.py") != []


@pytest.mark.parametrize(
    "code",
    [
        "from beal.vehicle.parts import Stage",
        "from . import basis",
        "from ..errors import ModelError",
        "import numpy",
    ],
)
def test_an_import_with_the_flow_passes(code):
    assert upward_imports(ast.parse(code), SOURCE / "beal/discretisation/somewhere.py") == []


@pytest.mark.parametrize(
    "code",
    [
        "try:\n    f()\nexcept:\n    pass",
        "try:\n    f()\nexcept Exception as error:\n    raise",
        "try:\n    f()\nexcept (ValueError, BaseException):\n    pass",
        "assert x > 0",
        "print(x)",
        "eval(x)",
        "exec(x)",
        "import pickle",
        "from marshal import loads",
    ],
)
def test_what_is_forbidden_is_seen(code):
    assert len(forbidden(ast.parse(code), SOURCE / "beal/discretisation/somewhere.py")) == 1


def test_the_command_line_may_print_and_use_the_whole_package():
    tree, path = ast.parse("import beal\nfrom beal.paper import figures\nprint(beal)"), SOURCE / "beal/cli.py"
    assert upward_imports(tree, path) == forbidden(tree, path) == []
