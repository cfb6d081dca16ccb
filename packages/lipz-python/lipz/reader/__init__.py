"""Reads lipz dialogue banks: the visemes, subtitles and events at any time.

This folder needs nothing but `struct` of the standard library, so you can copy it into a program.
"""

from .articulation import ARTICULATORS, DEFAULT_ARTICULATION, Articulation, ArticulationProfile
from .babble import DEFAULT_BABBLE, Babble
from .bank import Bank
from .clip import Clip
from .cursor import CharacterState, Cursor, Due
from .curves import Curve
from .emotions import EMOTIONS, Emotions
from .errors import BankError
from .events import Event
from .face import FACE_VALUES, Face, idle_face
from .face_profile import AHEAD, DEFAULT_FACE_PROFILE, FaceProfile, LookAt
from .ids import clip_id
from .phones import Phones
from .rig import Rig
from .segment import Segment
from .shapes import Shapes, shapes_of
from .texts import Text
from .times import Fps, Micros, Samples
from .voices import Recording, VoicedClip

__all__ = [
    "AHEAD",
    "ARTICULATORS",
    "Articulation",
    "ArticulationProfile",
    "Babble",
    "Bank",
    "BankError",
    "CharacterState",
    "Clip",
    "Cursor",
    "Curve",
    "DEFAULT_ARTICULATION",
    "DEFAULT_BABBLE",
    "DEFAULT_FACE_PROFILE",
    "Due",
    "EMOTIONS",
    "Emotions",
    "Event",
    "FACE_VALUES",
    "Face",
    "FaceProfile",
    "Fps",
    "LookAt",
    "Micros",
    "Phones",
    "Recording",
    "Rig",
    "Samples",
    "Segment",
    "Shapes",
    "Text",
    "VoicedClip",
    "clip_id",
    "idle_face",
    "open_bank",
    "shapes_of",
]


def open_bank(path: str, *texts: str) -> Bank:
    """Opens the bank in a file, with the text banks in other files, and compares their checksums.

    Raises BankError if a file is not a bank or is damaged, and OSError if it cannot be read.
    """
    bank = Bank(_read(path)).verify_checksum()
    return bank.with_texts(*map(_read, texts), verify_checksums=True) if texts else bank


def _read(path: str) -> bytes:
    with open(path, "rb") as file:
        return file.read()
