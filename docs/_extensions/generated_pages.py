"""Pages that are written from the code: the examples as they ran, and the reference of all public names."""

import importlib
import inspect
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
from itertools import groupby
from pathlib import Path

from sphinx.application import Sphinx

import beal

ROOT = Path(__file__).parents[2]
PLACES = {
    "README.md": "index.md",
    "benchmarks/README.md": "generated/benchmarks.md",
    "benchmarks/peers/README.md": "generated/peers.md",
}


def write_gallery(folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    text = "# Gallery\n\nThe scripts, models and studies of the folder `examples`, with what they print and draw.\n\n"
    examples = [path for path in sorted((ROOT / "examples").iterdir()) if path.suffix in SHOWN]
    for example in examples:
        page, picture = (folder / f"{example.stem}.{ending}" for ending in ("md", "png"))
        if not page.exists() or page.stat().st_mtime < example.stat().st_mtime:
            page.write_text(SHOWN[example.suffix](example, picture), encoding="utf-8")
        title = page.read_text(encoding="utf-8").partition("\n")[0].removeprefix("# ")
        text += f"## [{title}](gallery/{page.name})\n\n![{title}](gallery/{picture.name})\n\n"
    contents = toctree([f"gallery/{example.stem}" for example in examples], hidden=True)
    folder.with_suffix(".md").write_text(text + contents, encoding="utf-8")


def executed(script: Path, picture: Path) -> str:
    """The page of a script: what it says of itself, its picture, its code and what it printed."""
    source = script.read_text(encoding="utf-8")
    _, words, code = source.split('"""', 2)
    title, _, rest = words.partition("\n")
    with tempfile.TemporaryDirectory() as place:
        run = [sys.executable, str(script), str(picture)]
        printed = subprocess.run(run, cwd=place, check=True, capture_output=True, text=True).stdout
    parts = [f"# {title.rstrip('.')}", rest.strip()]
    parts.append(f"![What the script draws]({picture.name})")
    parts += [f"```python\n{code.strip()}\n```", "It prints", f"```text\n{printed.rstrip()}\n```"]
    return "\n\n".join(part for part in parts if part) + "\n"


def answered(file: Path, picture: Path) -> str:
    """The page of a model or of a study: its text, and what the command about it prints and draws."""
    text = file.read_text(encoding="utf-8")
    command = ["map", file.name, "-o", f"{file.stem}.zarr"] if "[grid]" in text else ["critical", file.name]
    with tempfile.TemporaryDirectory() as place:
        shutil.copytree(file.parent, place, dirs_exist_ok=True)
        run = [str(Path(sys.executable).with_name("beal")), *command, "--figure", str(picture)]
        printed = subprocess.run(run, cwd=place, check=True, capture_output=True, text=True).stdout
    title = tomllib.loads(text).get("title", file.stem.replace("_", " "))
    line = " ".join(["$ beal", *command, "--figure", picture.name])
    parts = [f"# {title[0].upper()}{title[1:]}", f"![What the command draws]({picture.name})"]
    parts += [f"`{file.name}`", f"```toml\n{text.strip()}\n```", f"```console\n{line}\n{printed.rstrip()}\n```"]
    return "\n\n".join(parts) + "\n"


SHOWN = {".py": executed, ".toml": answered}


def write_reference(folder: Path) -> None:
    """One page for each room of the package, with the public names that live there."""
    folder.mkdir(parents=True, exist_ok=True)
    homes = sorted(beal._HOMES.items(), key=lambda item: (room(item[1]), item[0].lower()))
    rooms = []
    for title, names in groupby(homes, key=lambda item: room(item[1])):
        parts = [f"{title}\n{'=' * len(title)}", summary(f"beal.{title}")]
        parts += [entry(f"beal.{name}", getattr(beal, name)) for name, _ in names]
        (folder / f"{title}.rst").write_text("\n\n".join(parts) + "\n", encoding="utf-8")
        rooms.append(title)
    text = "# Reference\n\nAll names are imported from `beal`; each page holds those of one part of the package.\n\n"
    folder.with_suffix(".md").write_text(text + toctree([f"reference/{name}" for name in rooms]), encoding="utf-8")


def room(home: str) -> str:
    return home.split(".")[1]


def summary(module: str) -> str:
    return (inspect.getdoc(importlib.import_module(module)) or "").partition("\n")[0]


def entry(path: str, value: object) -> str:
    if inspect.ismodule(value):
        names = getattr(value, "__all__", None) or [n for n, f in vars(value).items() if own(f, value)]
        title = f"{path}\n{'-' * len(path)}\n\n{(inspect.getdoc(value) or '').partition(chr(10))[0]}"
        return "\n\n".join([title, *(entry(f"{path}.{name}", getattr(value, name)) for name in names)])
    if inspect.isclass(value):
        return f".. autoclass:: {path}\n   :members:\n   :exclude-members: model_config"
    return f".. autofunction:: {path}"


def own(value: object, module: object) -> bool:
    return inspect.isfunction(value) and value.__module__ == module.__name__ and not value.__name__.startswith("_")


def write_benchmarks(page: Path) -> None:
    for source, target in (("README.md", page), ("peers/README.md", page.with_name("peers.md"))):
        text = (ROOT / "benchmarks" / source).read_text(encoding="utf-8")
        target.write_text(text.replace("peers/README.md", "peers.md"), encoding="utf-8")


def toctree(entries: list[str], hidden: bool = False) -> str:
    return "\n".join(["```{toctree}", *([":hidden:", ""] if hidden else []), *entries, "```", ""])


def lead_to_pages(app: Sphinx, name: str, source: list[str]) -> None:
    """Links of a page to files of the repository lead to the pages of the manual that hold the same."""
    if "/" not in name:
        source[0] = re.sub(r"\]\(\.\./([\w/]+\.md)\)", lambda link: f"]({PLACES[link[1]]})", source[0])


def keep_bars(app: Sphinx, what: str, name: str, value: object, options: object, lines: list[str]) -> None:
    """Moduli such as |s| are no substitutions of reStructuredText."""
    lines[:] = [line if ">>>" in line or "``" in line else line.replace("|", r"\|") for line in lines]


def write(app: Sphinx) -> None:
    folder = Path(app.srcdir) / "generated"
    write_gallery(folder / "gallery")
    write_reference(folder / "reference")
    write_benchmarks(folder / "benchmarks.md")


def setup(app: Sphinx) -> dict[str, bool]:
    app.connect("builder-inited", write)
    app.connect("source-read", lead_to_pages)
    app.connect("autodoc-process-docstring", keep_bars, priority=900)  # after numpydoc
    return {"parallel_read_safe": True, "parallel_write_safe": True}
