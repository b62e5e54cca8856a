"""The public list is what is really there."""

import inspect

import beal


def test_the_public_list_is_sorted_and_without_repetition():
    assert list(beal.__all__) == sorted(set(beal.__all__))


def test_every_listed_name_exists():
    assert [name for name in beal.__all__ if not hasattr(beal, name)] == []


def test_nothing_public_is_left_off_the_list():
    there = {name for name, value in vars(beal).items() if not name.startswith("_") and not is_submodule(value)}
    assert there - set(beal.__all__) == set()


def is_submodule(value: object) -> bool:
    return inspect.ismodule(value) and value.__name__.startswith("beal.")
