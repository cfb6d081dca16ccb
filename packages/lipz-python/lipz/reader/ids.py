"""The hash of clip ids and of random numbers, and the clip index."""

from __future__ import annotations

U64 = 0xFFFF_FFFF_FFFF_FFFF
U32 = 0xFFFF_FFFF
STEP = 0x9E37_79B9_7F4A_7C15
FINISH = 0x9FB2_1C65_1E98_DF25
_DIRECT_SLOT = 0x8000_0000


def mix(value: int, multiplier: int) -> int:
    """Multiplies two numbers of 64 bits, and folds the high half of the product into the low half."""
    product = value * multiplier & U64
    return product ^ product >> 32


def clip_id(key: str) -> int:
    """Returns the id of a key. It is the same in all banks."""
    data = key.encode("utf-8", "surrogatepass")
    value = mix(len(data), STEP)
    whole = len(data) // 8 * 8
    for at in range(0, whole, 8):
        value = mix(value ^ int.from_bytes(data[at : at + 8], "little"), STEP)
    return mix(mix(value ^ int.from_bytes(data[whole:], "little"), STEP), FINISH)


def slot_of(own_id: int, seed: int, pilots: memoryview | tuple[int, ...], clip_count: int) -> int:
    """Returns the slot in which the clip with this id is, if the bank contains it."""
    spread = mix(own_id ^ seed, STEP)
    pilot: int = pilots[(spread >> 32) * len(pilots) >> 32]
    if pilot & _DIRECT_SLOT:
        return pilot - _DIRECT_SLOT
    mixed = ((spread & U32) ^ (pilot * 0x9E37_79B9 & U32)) * 0x85EB_CA6B & U32
    mixed = (mixed ^ mixed >> 15) * 0xC2B2_AE35 & U32
    return mixed * clip_count >> 32
