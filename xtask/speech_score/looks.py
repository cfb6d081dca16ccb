"""The looks of the mouth that fit a phone: R at rest, M closed lips, F lip under the teeth, O round, A open, S narrow."""

LOOKS = {
    'R': 'pau sil # _',
    'M': 'p b m',
    'F': 'f v nf',
    'O': 'w ow uw oo',
    'OA': 'ao aw oy o O u U uh y oe',
    'A': 'aa ae ah ay eh ey a e E ea',
    'AS': 'ih iy i I',
    'AOS': 'ax er axr @ hh',
    'SO': 'r sh zh ch jh S Z tS dZ rr',
    'SA': 'k g ng N x y: j J ny h',
    'S': 't d n s z th dh l ts dz dx nx c L D T en el',
    'MS': 'B',
}
OF_PHONE = {phone: looks for looks, phones in LOOKS.items() for phone in phones.split()}

# Other names for phones, used by some voices.
OTHERS = {
    'en': {'y': 'j'},
    'it': {'y': 'j'},
    'cs': {'ch': 'x', 'c~': 'tS', 's~': 'S', 'z~': 'Z', 'r~': 'r', 'r*': 'r', 'n~': 'ny', 't~': 't', 'd~': 'd', 'h': 'h',
           'dz~': 'dZ', 'N*': 'ng', 'n*': 'ng', 'v': 'v'},
    'fi': {'ä': 'ea', 'ö': 'oe', '7': 'oe', 'å': 'o'},
    'ca': {'ax': '@', 'uw': 'w', 'y': 'j', 'X': 'x', 'th': 'th'},
}


def looks(phone, language):
    """Returns the looks that fit a phone of a voice; for an unknown phone, those of its first letter."""
    plain = phone.rstrip('0123456789:~')
    for name in (phone, plain):
        name = OTHERS[language].get(name, name)
        if name in OF_PHONE:
            return OF_PHONE[name]
    first = OTHERS[language].get(plain[:1], plain[:1])
    if first in OF_PHONE:
        return OF_PHONE[first]
    raise SystemExit(f'nobody knows how {phone!r} looks ({language})')
