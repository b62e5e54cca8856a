"""The reference documentation is the docstrings: they are there, complete, and their examples are true."""

import doctest
import importlib
import inspect
import pkgutil
import re
from collections.abc import Iterator
from functools import cached_property

import pytest

import beal

MODULES = sorted({"beal", *(module.name for module in pkgutil.walk_packages(beal.__path__, "beal."))})


def public(name: str, value: object) -> Iterator[tuple[str, object]]:
    """The function or class, a class's own methods and properties, a module's own functions and classes."""
    if inspect.ismodule(value) and value.__name__.startswith("beal."):
        names = getattr(value, "__all__", [key for key in vars(value) if not key.startswith("_")])
        for key in names:
            member = getattr(value, key)
            if getattr(member, "__module__", "").startswith(value.__name__):
                yield from public(f"{name}.{key}", member)
    elif (inspect.isclass(value) or is_function(value)) and value.__module__.startswith("beal"):
        yield name, value
        if inspect.isclass(value):
            own = {key: member for key, member in vars(value).items() if not key.startswith("_")}
            described = (property, cached_property, classmethod, staticmethod)
            yield from (
                (f"{name}.{key}", member)
                for key, member in own.items()
                if is_function(member) or isinstance(member, described)
            )


def is_function(value: object) -> bool:
    """Whether it is a function, decorated or not."""
    return inspect.isfunction(inspect.unwrap(value))


PUBLIC = dict(pair for name in beal.__all__ for pair in public(name, getattr(beal, name)))
FUNCTIONS = {name: value for name, value in PUBLIC.items() if is_function(value) and "." not in value.__qualname__}


def sentence_problem(doc: str | None) -> str:
    """Why the first line of a docstring is not one sentence; empty where it is."""
    first, *rest = (doc or "").splitlines() or [""]
    if not first:
        return "there is no docstring, or its first line is empty"
    if not first.endswith((".", ".``")):
        return f"the first line does not end its sentence: {first}"
    if re.search(r"\.\s+[A-Z]", first):
        return f"the first line holds more than one sentence: {first}"
    return f"no empty line follows the first: {first}" if rest and rest[0].strip() else ""


def undocumented(parameters: list[str], doc: str) -> list[str]:
    """Parameters without an entry ``name : type`` (or ``a, b : type``) in the section Parameters."""
    section = re.search(r"^Parameters\n-+\n(.*?)(?=^\S[^\n]*\n-{3,}$|\Z)", doc, re.DOTALL | re.MULTILINE)
    entries = re.findall(r"^(\*{0,2}\w[\w, *]*?)(?: :|$)", section[1] if section else "", re.MULTILINE)
    named = {name.strip(" *") for entry in entries for name in entry.split(",")}
    return [name for name in parameters if name not in named]


@pytest.mark.parametrize("name", PUBLIC)
def test_every_public_name_says_what_it_is_in_one_sentence(name):
    assert sentence_problem(inspect.getdoc(PUBLIC[name])) == ""


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_public_function_documents_its_parameters(name):
    function = FUNCTIONS[name]
    assert undocumented(list(inspect.signature(function).parameters), inspect.getdoc(function) or "") == []


@pytest.mark.parametrize("name", MODULES)
def test_examples_in_docstrings_are_true(name):
    module = importlib.import_module(name)
    assert module.__doc__, "the module does not say what it is for"
    assert doctest.testmod(module, optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE).failed == 0


@pytest.mark.parametrize("doc", [None, "", "No full stop", "One. Two.", "Run on\nand on.", "A line.\nAnother."])
def test_a_poor_first_line_is_seen(doc):
    assert sentence_problem(doc) != ""


def test_a_parameter_without_an_entry_is_seen():
    doc = "Add.\n\nParameters\n----------\na, b : float\n    In m.\n**rest\n\nReturns\n-------\nc : float\n"
    assert undocumented(["a", "b", "c", "d", "rest"], doc) == ["c", "d"]
