extends RefCounted
## The cases of fixtures/playback/cases.txt. Prints the file with the answers of this reader, which must be the same.

const Clock := preload("res://addons/lipz/clock.gd")
const Articulation := preload("res://addons/lipz/articulation.gd")
const Emotions := preload("res://addons/lipz/emotions.gd")
const Files := preload("files.gd")

const _FEATURES: Array[String] = [
	"lead", "states", "hold", "refresh", "text-banks", "babble", "curves", "emotions", "faces", "voices",
	"articulation",
]

var _bank: LipzBank
var _locale: LipzLocale
var _clip: LipzClip
var _cursor: LipzCursor
var _answers := PackedStringArray()


func _say(line: String) -> void:
	_answers.append("  " + line)


static func _thousandths(value: float) -> String:
	return str(roundi(value * 1000.0))


## Reads a time of two or three words, and removes them.
static func _take_time(words: Array) -> int:
	var unit: String = words.pop_front()
	var word: String = words.pop_front()
	match unit:
		"us":
			return Clock.BEFORE_NS if word == "-9223372036854775808" else Clock.of_us(word.to_int())
		"samples":
			return Clock.of_samples(word.to_int(), int(words.pop_front()))
		"f32":
			return _of_single(word)
	return Clock.of_seconds(_number(word))


static func _number(word: String) -> float:
	return {"nan": NAN, "inf": INF, "-inf": -INF}.get(word, word.to_float())


## Returns the time of a number of 32 bits, whose two units in the last place are tolerated.
static func _of_single(word: String) -> int:
	var bytes := PackedByteArray([0, 0, 0, 0])
	bytes.encode_float(0, _number(word))
	if not is_finite(bytes.decode_float(0)) or bytes.decode_float(0) < 0.0:
		return Clock.of_seconds(bytes.decode_float(0))
	bytes.encode_u32(0, bytes.decode_u32(0) + 2)
	return Clock.of_seconds(bytes.decode_float(0))


## Removes `of NAME` or `speaker NAME` from the start of the words. Returns the name, and whether it is the speaker's.
static func _take_who(words: Array) -> Array:
	if words[0] != "of" and words[0] != "speaker":
		return ["", true]
	var is_speaker: bool = words.pop_front() == "speaker"
	return [words.pop_front(), is_speaker]


static func _take_look(words: Array) -> Array:
	var kind: String = words.pop_front()
	if kind == "ahead":
		return [Vector2.ZERO, true]
	return [Vector2(int(words.pop_front()) / 1000.0, int(words.pop_front()) / 1000.0), kind == "person"]


func _show() -> void:
	var frame := str(_cursor.frame()) if _cursor.frame() >= 0 else ("over" if _cursor.is_over() else "waiting")
	var line := "frame %s, viseme %s" % [frame, _cursor.viseme()]
	if _cursor.openness() >= 0.0:
		line += ", open %d" % roundi(_cursor.openness() * 10000.0)
	var segment := _cursor.segment()
	if segment >= 0:
		line += ", segment %d" % segment
		if _cursor.clip.has_text(segment, _locale):
			line += ": " + _cursor.text(_locale)
			line += " (fallback)" if _cursor.clip.is_fallback(segment, _locale) else ""
	_say(line)


func _show_due(events: Array[LipzEvent]) -> void:
	_show()
	for segment in _cursor.due_segments:
		var event := _cursor.clip.event(segment)
		var has := (": " + event if event != "" else ":") if _cursor.clip.has_events else ""
		_say("due %d%s" % [segment, has])
	for event in events:
		_say("event " + str(event))


func _show_state(name: String, state: Dictionary) -> void:
	var words := ["emotion", "stares_at", "points_at"].map(func(field: String) -> String: return state.get(field, "-"))
	words.push_front(name if name != "" else "-")
	_say("%s: feels %s, stares %s, points %s" % words)


func _start(words: Array) -> void:
	_clip = _bank.clip(words.pop_front())
	while not words.is_empty():
		if words.pop_front() == "rate":
			var rate: PackedStringArray = words.pop_front().split("/")
			_clip = _clip.or_fps(rate[0].to_int(), rate[1].to_int())
		else:
			_clip = _clip.or_viseme_type(words.pop_front())
	_cursor = _clip.cursor()
	if _cursor == null:
		_say("no frame rate")


func _open(bank_name: String) -> void:
	_bank = Files.bank(bank_name)
	_locale = null
	if _cursor != null and _bank.clip(_clip.key) != null:
		_cursor.resume(_bank.clip(_clip.key))


func _command(line: String) -> void:
	var words := Array(line.split(" "))
	var command: String = words.pop_front()
	match command:
		"bank":
			_open(words[0])
		"texts":
			_bank.open_texts(Files.golden(words[0] + ".lipztexts"))
		"locale":
			_locale = _bank.locale(words[0])
			if _locale == null:
				_say("no locale")
		"variant":
			_locale = _bank.variant(_locale, words[0])
			_say(_locale.tag)
		"clip":
			_start(words)
		"speaker":
			_cursor.set_speaker(words[0])
		"lead":
			if words[0] in ["one", "two"]:
				_cursor.set_lead_frames(1 if words[0] == "one" else 2)
			else:
				_cursor.lead_us = int(words[0])
		"hold":
			_hold(words)
		"advance":
			_show_due(_cursor.advance_to_ns(_take_time(words)))
		"loop":
			_show_due(_cursor.loop_to_ns(_take_time(words)))
		"seek":
			_cursor.seek_ns(_take_time(words))
			_show()
		"finish":
			_show_due(_cursor.finish())
		"state":
			var name: String = words[0].trim_prefix("-")
			_show_state(name, _cursor.state(name))
		"characters":
			var found := _cursor.characters()
			for name in found:
				_show_state(name, found[name])
		_:
			_ask(command, words)


func _hold(words: Array) -> void:
	match words[0]:
		"readable":
			_cursor.set_hold_readable()
		"display":
			_cursor.set_hold_for_display(int(words[1]))
		_:
			_cursor.hold = int(words[0])


func _ask(command: String, words: Array) -> void:
	match command:
		"babble":
			_babble(words)
		"curves":
			for curve in _clip.curves():
				var keys := range(curve.key_count).map(func(index: int) -> String:
					return "%d:%s" % [curve.key_frame(index), _thousandths(curve.key_value(index))])
				_say("%s: %s" % [curve.name, " ".join(keys)])
		"curve":
			_curve(words)
		"emotions":
			_emotions(words)
		"face":
			_face(words)
		"idle":
			_idle(words)
		"articulation":
			_articulation(words)
		"weights":
			_weights(words)
		"voices":
			for tag in _bank.voices():
				_say(tag)
		"voice":
			_voice(words[0])
		_:
			_say("no command")


func _babble(words: Array) -> void:
	var babble := _bank.babble(words.pop_front())
	if babble == null:
		_say("no profile")
		return
	var elapsed := _take_time(words)
	var power := _number(words[1]) / (65536.0 if words[0] == "level" else 1.0)
	var found := babble.at_ns(elapsed, power)
	_say("ooh %d, aah %d" % [roundi(found.x * 10000.0), roundi(found.y * 10000.0)])


func _curve(words: Array) -> void:
	var curve := _clip.curve(words.pop_front())
	if curve == null:
		_say("no curve")
	elif words[0] == "frame":
		_say(_thousandths(curve.value(int(words[1]))))
	elif _clip.fps_numerator == 0:
		_say("no frame rate")
	else:
		_say(str(curve._thousandths_at(_take_time(words))))


func _emotions(words: Array) -> void:
	var who := _take_who(words)
	var values := Emotions.thousandths(_clip, _take_time(words), who[0], who[1])
	var line := " "
	var sum := 0
	for index in values.size():
		sum += values[index]
		if values[index] != 0:
			line += " %s %d," % [Emotions.NAMES[index], values[index]]
	var strongest := Emotions.strongest(values)
	_answers.append("%s strongest %s, sum %d" % [line, Emotions.NAMES[strongest] if strongest >= 0 else "neutral", sum])


func _show_face(face: LipzFace) -> void:
	var values := [
		face.blink, face.head_pitch, face.head_yaw, face.head_roll, face.eye_pitch, face.eye_yaw, face.brows,
		face.shrug, face.breath,
	]
	_say("blink %s, head %s %s %s, eyes %s %s, brows %s, shrug %s, breath %s" % values.map(_thousandths))


func _face(words: Array) -> void:
	var who := _take_who(words)
	var profile := _bank.face_profile(words.pop_front())
	var look := _take_look(words)
	if profile == null:
		_say("no profile")
	else:
		_show_face(LipzFace._at_ns(_clip, _take_time(words), who[0], who[1], look[0], look[1], profile))


func _idle(words: Array) -> void:
	var profile := _bank.face_profile(words.pop_front())
	var look := _take_look(words)
	var word: String = words.pop_front()
	var of_seed := -1 if word == "18446744073709551615" else word.to_int()
	if profile == null:
		_say("no profile")
	else:
		_show_face(LipzFace._idle_ns(_take_time(words), of_seed, look[0], look[1], profile))


func _articulation(words: Array) -> void:
	var profile := _bank.articulation(words.pop_front())
	if profile == null:
		_say("no profile")
		return
	var values := profile.thousandths(_clip, _take_time(words))
	var list := PackedStringArray()
	for index in values.size():
		list.append("%s %d" % [Articulation.NAMES[index], values[index]])
	_say(", ".join(list))


func _weights(words: Array) -> void:
	var rig := _bank.rig(words.pop_front())
	var profile := _bank.articulation(words.pop_front())
	if rig == null or profile == null:
		_say("no rig" if rig == null else "no profile")
		return
	var weights := PackedFloat32Array()
	weights.resize(rig.weight_names.size())
	rig._weights_at_ns(_clip, _take_time(words), weights, "", true, profile)
	var list := PackedStringArray()
	for index in weights.size():
		list.append("%s %s" % [rig.weight_names[index], _thousandths(weights[index])])
	_say(", ".join(list))


func _voice(tag: String) -> void:
	if not tag in _bank.voices():
		_say("no voice")
		return
	var played := LipzVoices.in_voice(_clip, tag)
	var spoken := LipzVoices.voice_of(played)
	var whose := "original" if LipzVoices.original_of(played) == null else ("dub" if spoken == tag else "other dub")
	_say("%s: %s, spoken in %s" % [whose, played.key, spoken])


## Plays all cases. Returns the number of commands, or a message about the first difference.
func play() -> String:
	var expected := Files.lines("res://fixtures/playback/cases.txt")
	var run := 0
	var skipped := 0
	var is_skipping := false
	for line in expected:
		var is_answer := line.begins_with("  ")
		if not is_answer or is_skipping:
			_answers.append(line)
		if line.begins_with("##"):
			is_skipping = false
		if line.begins_with("needs "):
			for feature in line.trim_prefix("needs ").split(" "):
				is_skipping = is_skipping or not feature in _FEATURES
		elif not is_answer and line != "" and not line.begins_with("#"):
			if is_skipping:
				skipped += 1
			else:
				run += 1
				_command(line)
	var problem := Files.difference("cases.txt", _answers, expected)
	return problem if problem != "" else "%d commands, %d skipped" % [run, skipped]
