# Lip sync for Ren'Py: shows the mouth of the character whose voice plays. See README.md.
#
# Copy this file into `game`, the bank to `game/dialogue.lipzbank`, and the folder `lipz/reader` of the Python package
# `lipz` to `game/python-packages/lipz_reader`. Needs Ren'Py 8. Licence: MIT OR Apache-2.0, like the reader.

init -100 python in lipz:

    from store import DynamicDisplayable

    ## The bank in `game`.
    bank_file = "dialogue.lipzbank"
    ## The part of the name of a voice file before the key of its clip: `voice/act1/mara-hello.ogg`.
    voice_folder = "voice/"
    ## The channel of the voices.
    voice_channel = "voice"
    ## For games with dubs, the voice of each language of Ren'Py: `{ "german" : "de-de" }`.
    voices = { }
    ## The frame rate of clips without their own.
    fps = 24
    ## The time by which visemes are ahead of the audio, in seconds.
    lead = 0.04
    ## The time from one picture of a mouth to the next, in seconds.
    delay = 1.0 / 60.0

    # Opened once all settings are made. It never changes, so Ren'Py does not save it.
    bank = None

    def open_bank():
        """Returns the bank. The author of the game sees the error of a missing or damaged one."""
        if not renpy.loadable(bank_file):
            raise Exception("lipz: `game/%s` is missing. Write it with `lipz pack -o game/%s`." % (bank_file, bank_file))
        from lipz_reader import Bank
        with renpy.file(bank_file) as file:
            return Bank(file.read()).verify_checksum()

    def clip():
        """Returns the clip of the voice that plays, or None."""
        name = renpy.music.get_playing(channel=voice_channel)
        if not name:
            return None
        # Without `<from 5>` before the name, and the extension behind it.
        name = name.rpartition(">")[2]
        if name.startswith(voice_folder):
            name = name[len(voice_folder):]
        found = bank.clip(name.rpartition(".")[0])
        voice = voices.get(renpy.store._preferences.language)
        return found.in_voice(voice).clip if found and voice else found

    def is_speaking(who):
        """Returns whether a character speaks. A character is the name of its variable, or a function of a clip."""
        if who is None:
            return True
        if callable(who):
            playing = clip()
            return playing is not None and bool(who(playing))
        return renpy.store._last_say_who == who

    def viseme(who=None):
        """Returns the viseme of a character now: a code, or `-` for rest."""
        playing = clip() if is_speaking(who) else None
        seconds = renpy.music.get_pos(channel=voice_channel)
        if playing is None or seconds is None:
            return "-"
        return playing.or_fps(fps).viseme_at(seconds + lead)

    def openness(who=None):
        """Returns how far the mouth of a character is open now, from 0 to 0.99."""
        playing = clip() if is_speaking(who) else None
        seconds = renpy.music.get_pos(channel=voice_channel)
        if playing is None or seconds is None:
            return 0.0
        return playing.or_fps(fps).openness_at(seconds + lead) or 0.0

    def picture(st, at, image, who):
        """Returns the image of the viseme, and the time after which to draw again."""
        code = viseme(who)
        return "%s %s" % (image, "rest" if code == "-" else code.lower()), delay

    def mouth(image, who=None):
        """
        Returns a displayable that shows the images `IMAGE a`, `IMAGE m`, ... and `IMAGE rest` while a character speaks.

        `who` is the name of the character's variable, as in `define mara = Character(...)`, or a function that takes
        the clip of a voice and returns whether it belongs to the character. By default, every voice moves the mouth.
        """
        return DynamicDisplayable(picture, image=image, who=who)

init 100 python in lipz:

    bank = open_bank()
