"""The shapes of a model, by their names: which of them take the weights of a rig."""

from __future__ import annotations

from .rig import Rig
from .shape_names import BARE, KINDS, forms_of, letters_of

# The most names that a report lists.
_LISTED = 5
# The forms of the names of weights, because a program recognises many models.
_KNOWN: dict[tuple[str, ...], list[str]] = {}


class Shapes:
    """The shapes of a model that take the weights of a rig.

    `kind` is the name of the rig or of the viseme type, or None if no shape is known. `map` has the name in the model
    of each weight for which the model has a shape. `missing` lists the other weights.
    """

    __slots__ = ("kind", "weight_names", "map", "missing", "_pairs")

    def __init__(self, kind: str | None, weight_names: list[str], map: dict[str, str]) -> None:
        self.kind = kind
        self.weight_names = weight_names
        self.map = map
        self.missing = [name for name in weight_names if name not in map]
        self._pairs = [(weight_names.index(weight), name) for weight, name in map.items()]

    @property
    def report(self) -> str | None:
        """A sentence about missing shapes, or None if the model has all of them."""
        if self.kind is None:
            return "none of the shapes has a known name: pass the rig that names them, or rename them"
        if not self.missing:
            return None
        more = [f"{len(self.missing) - _LISTED} more"] if len(self.missing) > _LISTED else []
        names = ", ".join([*self.missing[:_LISTED], *more])
        return f"{len(self.missing)} of {len(self.weight_names)} shapes of {self.kind} are missing: {names}"

    def named(self, weights: list[float]) -> list[tuple[str, float]]:
        """Returns the name in the model and the weight of each shape."""
        if len(weights) != len(self.weight_names):
            raise ValueError(f"there are {len(weights)} weights, but {len(self.weight_names)} of {self.kind}")
        return [(name, weights[index]) for index, name in self._pairs]

    def shown(self, viseme: str) -> list[tuple[str, float]]:
        """Returns 1 for the shape of a viseme, and 0 for the others, for models with a shape for each code."""
        return [(name, 1.0 if self.weight_names[index] == viseme else 0.0) for index, name in self._pairs]


def shapes_of(names: list[str], rig: Rig | None = None) -> Shapes:
    """Recognises the shapes of a model by their names. With a rig of a bank, finds the shapes for its weights."""
    forms = _forms_in(names)
    if rig is not None:
        also = KINDS[rig.name].also if rig.name in KINDS else {}
        return Shapes(rig.name, rig.weight_names, _names_for(rig.weight_names, forms, also))
    best = Shapes(None, [], {})
    most = 0
    for name, kind in KINDS.items():
        count = len(_names_for(kind.mouth, forms, kind.also))
        if count > most:
            most = count
            all_names = [*kind.mouth, *kind.rest]
            best = Shapes(name, all_names, _names_for(all_names, forms, kind.also))
    return best


def _forms_in(names: list[str]) -> list[dict[str, str]]:
    """Returns, for each degree of similarity, the names of a model by their form in this degree."""
    degrees: list[dict[str, str]] = []
    for name in names:
        for degree, form in enumerate(forms_of(name)):
            if degree == len(degrees):
                degrees.append({})
            if form:
                degrees[degree].setdefault(form, name)
    return degrees


def _names_for(weights: list[str], degrees: list[dict[str, str]], also: dict[str, list[str]]) -> dict[str, str]:
    """Returns the most similar name for each weight that has one."""
    found = {}
    for weight in weights:
        known = _known_forms((weight, *also.get(weight, ())))
        for by_form in degrees:
            form = next((form for form in known if form in by_form), None)
            if form is not None:
                found[weight] = by_form[form]
                break
    return found


def _known_forms(names: tuple[str, ...]) -> list[str]:
    """Returns the forms of the names of a weight, the most similar first."""
    known = _KNOWN.get(names)
    if known is None:
        # A rig may have a prefix that the model lacks, so the bare weight comes last.
        known = _KNOWN[names] = [*map(letters_of, names), forms_of(names[0])[BARE]]
    return known
