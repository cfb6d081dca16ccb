@icon("icon.svg")
class_name LipzMouth2D
extends Node
## Shows the visemes of a [LipzPlayer] with pictures of a mouth: the animations of an [AnimatedSprite2D] whose names
## are visemes ([code]A[/code], [code]E[/code] ...), or the frames of a [Sprite2D] in a given order.

## The player whose clips move the mouth.
@export var player: LipzPlayer:
	set(value):
		if player != null and player.viseme_changed.is_connected(show_viseme):
			player.viseme_changed.disconnect(show_viseme)
		player = value
		if player != null:
			player.viseme_changed.connect(show_viseme)
## An [AnimatedSprite2D] or a [Sprite2D].
@export var sprite: Node2D
## For a [Sprite2D]: the visemes of its frames, in order, such as `-AEFLMOSUW`.
@export var frame_order := "-AEFLMOSUW"
## The name of the animation for rest, in addition to `-`.
@export var rest_animation := "rest"


## Shows a viseme. A viseme without a picture is shown as rest.
func show_viseme(viseme: String) -> void:
	var animated := sprite as AnimatedSprite2D
	if animated != null:
		var frames := animated.sprite_frames
		var shown := viseme if frames.has_animation(viseme) else "-"
		animated.play(shown if frames.has_animation(shown) else rest_animation)
		return
	var pictures := sprite as Sprite2D
	if pictures != null:
		pictures.frame = maxi(frame_order.find(viseme), maxi(frame_order.find("-"), 0))
