"""The names that models give to their shapes: shape keys, blend shapes, expressions, parameters."""

from __future__ import annotations


def _both_sides(*names: str) -> list[str]:
    return [name + side for name in names for side in ("Left", "Right")]


class Kind:
    """A kind of shapes: the weights of the mouth, by which it is recognised, all others, and further names of some."""

    __slots__ = ("mouth", "rest", "also")

    def __init__(self, mouth: list[str], rest: list[str], also: dict[str, list[str]]) -> None:
        self.mouth = mouth
        self.rest = rest
        self.also = also


# Each kind has the name of the rig whose weights its shapes take, or of a viseme type.
KINDS = {
    # Apple: ARFaceAnchor.BlendShapeLocation.
    "arkit": Kind(
        "jawOpen mouthClose mouthFunnel mouthPucker mouthRollLower mouthRollUpper mouthShrugLower".split()
        + _both_sides(
            *("mouthPress", "mouthStretch", "mouthSmile", "mouthFrown", "mouthUpperUp", "mouthLowerDown"),
        ),
        ["tongueOut", *_both_sides("cheekSquint", "noseSneer", "browDown"), "browInnerUp"]
        + _both_sides("browOuterUp", "eyeWide", "eyeSquint", "eyeBlink"),
        {},
    ),
    # OpenXR: XrFaceTrackingVisemeMETA. Oculus Lipsync had single letters for the last three.
    "ovr": Kind("sil PP FF TH DD kk CH SS nn RR aa E ih oh ou".split(), [], {"ih": ["I"], "oh": ["O"], "ou": ["U"]}),
    # VRM 1.0: VRMC_vrm, expressions. The other names are from VRM 0 and VRoid.
    "vrm": Kind(
        "aa ih ou ee oh".split(),
        "happy angry sad surprised blink".split(),
        {
            **{"aa": ["A"], "ih": ["I"], "ou": ["U"], "ee": ["E"], "oh": ["O"]},
            **{"happy": ["Fcl_ALL_Joy", "Joy"], "angry": ["Fcl_ALL_Angry"], "sad": ["Fcl_ALL_Sorrow", "Sorrow"]},
            **{"surprised": ["Fcl_ALL_Surprised"], "blink": ["Fcl_EYE_Close"]},
        },
    ),
    "mmd": Kind(list("あいうえおん"), ["まばたき", "にこり", "怒り", "困る"], {}),
    # Cubism: "Standard Parameter List". Cubism 2 wrote PARAM_MOUTH_OPEN_Y.
    "live2d": Kind(["ParamMouthOpenY", "ParamMouthForm"], ["ParamEyeLOpen", "ParamEyeROpen"], {}),
    # Viseme types: a shape for each code.
    "blair": Kind(list("AEFLMOSUW"), ["-"], {"-": ["rest"]}),
    "toonboom": Kind(list("ABCDEFG"), ["-"], {"-": ["rest", "X"]}),
    "rms": Kind(list("0123456789"), ["-"], {"-": ["rest"]}),
}

# The kinds of shapes before their names, in lower case: `viseme_aa`, `v_aa`, `Fcl_MTH_A`, `Mouth_A`.
_PREFIXES = ("arkit", "fcl_mth", "lipsync", "mouth", "mth", "phoneme", "v", "viseme")
# The place of the bare name among the forms.
BARE = 2


def letters_of(name: str) -> str:
    """Returns the letters and digits of a name in lower case, which alone are compared."""
    # A hyphen is the code of rest.
    return name if name == "-" else "".join(letter for letter in name if letter.isalnum()).lower()


def forms_of(name: str) -> list[str]:
    """Returns the forms in which a name is compared, in the order of their similarity to it."""
    plain, sided = _without_path(name), _without_path(_with_side(name))
    forms = (name, plain, _without_prefix(plain), sided, _without_prefix(sided))
    return [letters_of(form) for form in forms]


def _without_path(name: str) -> str:
    """Removes the names of meshes and deformers: `blendShape1.jawOpen`, `M_F00_000_00_Fcl_MTH_A`."""
    at = max(name.rfind("Fcl_"), max((name.rfind(letter, 0, -1) + 1 for letter in ".:|/"), default=0))
    return name[max(at, 0) :]


def _without_prefix(name: str) -> str:
    for prefix in _PREFIXES:
        if name.lower().startswith(prefix) and name[len(prefix) : len(prefix) + 1] in ("_", " ", "-"):
            return name[len(prefix) + 1 :]
    return name


def _with_side(name: str) -> str:
    """Writes the short form of a side at the end of a name in full: `mouthSmile_L`, `eyeBlink.R`, `jawL`."""
    side = {"l": "Left", "r": "Right"}.get(name[-1:].lower())
    before = name[-2:-1]
    if side is None or not before:
        return name
    if before in "_. -":
        return name[:-2] + side
    return name[:-1] + side if "a" <= before <= "z" and name[-1].isupper() else name
