# Plays the sample without a player, and writes what the mouths showed to `seen.jsonl`, one picture per line.

init -50 python in lipz:
    import json
    from store import config

    drawn = picture

    def playing_now():
        return [ renpy.music.get_playing(channel="voice"), renpy.music.get_pos(channel="voice") ]

    def picture(st, at, image, who):
        # The voice goes on while the image is chosen.
        before = playing_now()
        found = drawn(st, at, image, who)
        after = playing_now()
        with open(config.basedir + "/seen.jsonl", "a") as file:
            file.write(json.dumps([ before, after, image, found[0] ]) + "\n")
        return found

    def has_played(name):
        try:
            with open(config.basedir + "/seen.jsonl") as file:
                return name in file.read()
        except IOError:
            return False

init 10 python:
    mara = Character("Mara", what_suffix="{w=1.4}{nw}")
    otto = Character("Otto", what_suffix="{w=1.4}{nw}")

label main_menu:
    if lipz.has_played("otto-twenty-years"):
        $ renpy.quit()
    return
