# Two characters speak two lines. The images of their mouths are letters. Put recordings of the lines into `game/voice`.

define mara = Character("Mara")
define otto = Character("Otto")

image mara mouth = lipz.mouth("mara shape", who="mara")
image otto mouth = lipz.mouth("otto shape", who=lambda clip: "otto" in clip.key)

init python:
    for code in "amosweflu":
        renpy.image("mara shape " + code, Text(code.upper(), size=200))
        renpy.image("otto shape " + code, Text(code.upper(), size=200))
    renpy.image("mara shape rest", Text("-", size=200))
    renpy.image("otto shape rest", Text("-", size=200))

label start:
    show mara mouth at left
    show otto mouth at right
    voice "voice/act1/mara-good-evening.ogg"
    mara "Good evening, Otto. You are late, and the fog is early."
    voice "voice/act1/otto-twenty-years.ogg"
    otto "I kept this light for twenty years."
    return
