"""Rigs: the weights of a model's shapes, computed from articulation, emotions and the face."""

from __future__ import annotations

import struct

_RIG = struct.Struct("<HHHH")
_WEIGHT = struct.Struct("<HHhh")
_TERM = struct.Struct("<hBB")
_NO_INPUT = 255
_MOST_INPUT = 4000
_WHOLE = 1000
_SUM_LIMIT = 0x7FFF_FFFF


class Rig:
    """The shapes of a model: `[rig.NAME]` in `lipz.toml` adds one to the bank. Each weight is a sum of terms."""

    __slots__ = ("name", "weight_names", "_weights")

    def __init__(self, name: str, weight_names: list[str], weights: list[tuple[list[tuple[int, int, int]], int, int]]):
        self.name = name
        self.weight_names = weight_names
        # The terms, the lowest and the highest value of each weight.
        self._weights = weights

    def weights_of(self, mouth: list[int], emotions: list[int], face: tuple[int, int, int]) -> list[float]:
        """Returns the weights of these inputs in thousandths. `face` consists of blink, brows and shrug."""
        inputs = [*mouth, *(int(value / 10) for value in emotions), *face, _WHOLE]
        inputs = [min(max(value, -_MOST_INPUT), _MOST_INPUT) for value in inputs]
        weights = []
        for terms, least, most in self._weights:
            total = 0
            for factor, first, second in terms:
                value = _divided(factor * (inputs[first] if first < len(inputs) else 0))
                if second != _NO_INPUT:
                    value = _divided(value * (inputs[second] if second < len(inputs) else 0))
                total = min(max(total + value, -_SUM_LIMIT), _SUM_LIMIT)
            weights.append(min(max(total, least), most) / _WHOLE)
        return weights


def _divided(product: int) -> int:
    """Returns a thousandth, rounded towards zero."""
    return product // _WHOLE if product >= 0 else -(-product // _WHOLE)


def rigs_in(data: memoryview) -> list[Rig]:
    """Returns the rigs of a section. A damaged rig ends the list."""
    rigs = []
    at = 0
    while at + _RIG.size <= len(data):
        name_length, weight_count, term_count, names_length = _RIG.unpack_from(data, at)
        weights_at = at + _RIG.size + name_length
        terms_at = weights_at + weight_count * _WEIGHT.size
        names_at = terms_at + term_count * _TERM.size
        if names_at + names_length > len(data):
            break
        name = str(data[at + _RIG.size : weights_at], "utf-8", "replace")
        terms = list(_TERM.iter_unpack(data[terms_at:names_at]))
        names, at = data[names_at : names_at + names_length], names_at + names_length
        weight_names, weights = [], []
        first_term = first_byte = 0
        for terms_end, names_end, least, most in _WEIGHT.iter_unpack(data[weights_at:terms_at]):
            weight_names.append(str(names[first_byte:names_end], "utf-8", "replace"))
            weights.append((terms[first_term:terms_end], least, most))
            first_term, first_byte = terms_end, names_end
        rigs.append(Rig(name, weight_names, weights))
    return rigs
