"""What every part of a vehicle shares: frozen, validated, every problem named by its path."""

import math
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, ValidationError, ValidationInfo
from pydantic_core import InitErrorDetails, PydanticCustomError

from beal.errors import ModelError
from beal.units import to_si

if TYPE_CHECKING:
    from pydantic._internal._model_construction import ModelMetaclass
else:
    ModelMetaclass = type(BaseModel)

CONTAINERS = {
    "tuple_type": "a list (of tables: [[name]], not [name])",
    "dict_type": "a table",
    "model_type": "a table",
    "model_attributes_type": "a table",
}


Misfit = tuple[tuple[str | int, ...], str, Any]  # location, message, input
PLAIN, TABLE = "a plain value", "a table"  # tags of the forms of a field, in pydantic's locations only


class _Checked(ModelMetaclass):
    """Turns pydantic's report into a ModelError, for direct construction only: nested parts keep their paths."""

    def __call__(cls, **fields: Any) -> Any:
        try:
            return super().__call__(**fields)
        except ValidationError as error:
            raise ModelError(problems(error, cls)) from None  # type: ignore[arg-type]


class Part(BaseModel, metaclass=_Checked):
    """Base of the vehicle's parts: immutable, and refuses keys that it does not know."""

    model_config = ConfigDict(frozen=True, extra="forbid", populate_by_name=True)

    def model_copy(self, *, update: Mapping[str, Any] | None = None, deep: bool = False) -> Self:
        """Copy with fields replaced, checked like a new part (frozen parts are shared, ``deep`` or not)."""
        fields = {name: getattr(self, name) for name in type(self).model_fields}
        return type(self)(**fields | dict(update or {}))


def together(kind: type[Part], data: Any, handler: Any, misfits: Callable[[dict[str, Any]], Iterable[Misfit]]) -> Any:
    """A part from raw input; checks across fields run even where one is wrong: all problems are reported at once."""
    errors: list[InitErrorDetails] = []
    try:
        part = handler(data)
    except ValidationError as error:
        errors = [_again(item) for item in error.errors(include_url=False)]
        fields = data if isinstance(data, dict) else {}
    else:
        fields = part.__dict__
    if errors := [*errors, *(_detail(*misfit) for misfit in misfits(fields))]:
        raise ValidationError.from_exception_data(kind.__name__, errors)
    return part


def refusal(kind: type[Part], misfits: Iterable[Misfit]) -> ValidationError:
    """The error that names some misfits."""
    return ValidationError.from_exception_data(kind.__name__, [_detail(*misfit) for misfit in misfits])


def _detail(location: tuple[str | int, ...], message: str, value: Any) -> InitErrorDetails:
    return {"type": PydanticCustomError("misfit", message), "loc": location, "input": value}


def _again(item: Any) -> InitErrorDetails:
    if item["type"] in ("value_error", "misfit") or "error" in item.get("ctx", {}):
        return _detail(item["loc"], str(item["msg"]).removeprefix("Value error, "), item["input"])
    return {"type": item["type"], "loc": item["loc"], "input": item["input"], "ctx": item.get("ctx", {})}


def problems(error: ValidationError, root: type[BaseModel]) -> list[tuple[str, str]]:
    """The pydantic errors as (path, message) with paths as the model file writes them."""
    keys = {name: field.alias or name for name, field in root.model_fields.items()}
    items = error.errors(include_url=False)
    return [
        (path((*(keys.get(str(key), key) for key in item["loc"][:1]), *item["loc"][1:])), _message(item, root))
        for item in items
    ]


def path(loc: tuple[int | str, ...]) -> str:
    """``("stage", 1, "length")`` as ``stage[1].length``."""
    text = ""
    for before, part in zip(("", *loc), loc, strict=False):
        if isinstance(part, int):
            text += f"[{part}]"
        elif part not in (PLAIN, TABLE) and before != "signal":  # after which comes the tag of the signal's kind
            text += f".{part}" if text else part
    return text


def _message(item: Any, root: type[BaseModel]) -> str:
    kind, found = item["type"], item.get("input")
    if kind == "extra_forbidden":
        return f"unknown key; known here: {', '.join(_known_keys(root, item['loc'][:-1]))}"
    if kind == "missing":
        return "is required and missing"
    if kind == "union_tag_not_found":
        return f"kind is required and missing, found {_short(found)}"
    if kind == "union_tag_invalid":
        return f"kind must be one of {item['ctx']['expected_tags']}, found {_short(item['ctx']['tag'])}"
    if (expected := CONTAINERS.get(kind)) is not None:
        return f"must be {expected}, found {_short(found)}"
    message = str(item["msg"]).removeprefix("Value error, ")
    message = message.replace("Input should be", "must be").replace("Input", "input")
    return message if "found" in message else f"{message}, found {_short(found)}"


def _short(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."


def _known_keys(root: Any, loc: tuple[int | str, ...]) -> list[str]:
    """Keys of the part that ``loc`` points into, found by walking the annotations."""
    for name in loc:
        if isinstance(name, int) or not hasattr(root, "model_fields"):
            continue
        fields = {field.alias or key: field.annotation for key, field in root.model_fields.items()}
        root = _part_in(fields.get(name)) or root
    return [field.alias or key for key, field in root.model_fields.items()]


def _part_in(annotation: Any) -> type[BaseModel] | None:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    for argument in getattr(annotation, "__args__", ()):
        if (part := _part_in(argument)) is not None:
            return part
    return None


def si(unit: str) -> BeforeValidator:
    """Marks a float that is kept in ``unit`` and may be given as a string with any compatible unit."""

    def parse(value: Any, info: ValidationInfo) -> Any:
        if isinstance(value, bool):
            raise ValueError("must be a number, found a boolean")
        if isinstance(value, str):
            if info.context and info.context.get("units") == "nondimensional":
                raise ValueError(f"a nondimensional model takes plain numbers, found {value!r}")
            value = to_si(value, unit)
        if isinstance(value, float) and math.isnan(value):
            raise ValueError("must be a number, found nan")
        return value

    parse.unit = unit  # type: ignore[attr-defined]  # for `unit_of`
    return BeforeValidator(parse)


def unit_of(annotation: Any, marks: Iterable[Any] = ()) -> str:
    """The SI unit of a field; empty for a pure number and for what is no number.

    Parameters
    ----------
    annotation : type
        Of the field.
    marks : iterable
        Those of the annotation itself, which pydantic keeps beside it.

    Examples
    --------
    >>> from typing import Annotated
    >>> unit_of(Annotated[float, si("N/m")] | None)
    'N/m'
    """
    own = (*marks, *getattr(annotation, "__metadata__", ()))
    found = [getattr(getattr(mark, "func", None), "unit", "") for mark in own]
    found += map(unit_of, getattr(annotation, "__args__", ()))
    return next(filter(None, found), "")
