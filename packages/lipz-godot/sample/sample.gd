extends Node2D
## Two characters who speak a line each, in two languages, with subtitles, events, emotions and a drawn face.

## The lines: key, speaker and language.
const LINES: Array[Array] = [
	["act1/mara-good-evening", "mara", "en-us"],
	["act1/otto-twenty-years", "otto", "de-de"],
]
const _SKIN: Dictionary[String, Color] = {"mara": Color("f2c7a6"), "otto": Color("d9bf99")}

var _line := -1
var _colour := Color.WHITE

@onready var _player: LipzPlayer = $Player
@onready var _subtitle: Label = $Subtitle
@onready var _event: Label = $Event


func _ready() -> void:
	_player.subtitle_changed.connect(func(text: String) -> void: _subtitle.text = text)
	_player.event_fired.connect(func(event: LipzEvent) -> void: _event.text = str(event))
	_player.finished.connect(_play_next, CONNECT_DEFERRED)
	_play_next()


func _play_next() -> void:
	_line += 1
	if _line < LINES.size():
		_player.locale = LINES[_line][2]
		_colour = _SKIN[LINES[_line][1]]
		_player.play(LINES[_line][0], LINES[_line][1])


func _process(_delta: float) -> void:
	queue_redraw()


func _draw() -> void:
	if not _player.is_playing():
		return
	var face := LipzFace.at(_player.clip, _player.time(), _player.speaker, true)
	var mouth := _player.clip.articulation_at(_player.time())
	draw_set_transform(Vector2(240.0 - face.head_yaw, 160.0 - face.head_pitch), deg_to_rad(face.head_roll))
	_draw_ellipse(Vector2.ZERO, Vector2(105.0, 125.0), _colour)
	for side: float in [-40.0, 40.0]:
		_draw_ellipse(Vector2(side, -30.0), Vector2(22.0, 14.0 * (1.0 - face.blink)), Color.WHITE)
		if face.blink < 0.8:
			draw_circle(Vector2(side - face.eye_yaw / 2.0, -30.0 - face.eye_pitch / 2.0), 6.0, Color.BLACK)
	var width := 45.0 - 22.0 * mouth["rounding"] + 14.0 * mouth["spreading"]
	var centre := Vector2(0.0, 50.0 + 10.0 * mouth["jaw"])
	_draw_ellipse(centre, Vector2(width, 5.0 + 38.0 * mouth["opening"]), Color("b34040"))
	_draw_ellipse(centre, Vector2(width - 5.0, 36.0 * mouth["opening"]), Color("330d14"))


func _draw_ellipse(centre: Vector2, radii: Vector2, colour: Color) -> void:
	var points := PackedVector2Array()
	for step in 40:
		points.append(centre + Vector2.from_angle(TAU * step / 40.0) * radii.max(Vector2(0.5, 0.5)))
	draw_colored_polygon(points, colour)
