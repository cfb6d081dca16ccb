extends RefCounted
## The golden dumps of fixtures/banks/v1. Prints the answers of this reader to every query, which must be the same.

const Articulation := preload("res://addons/lipz/articulation.gd")
const FaceProfile := preload("res://addons/lipz/face_profile.gd")
const Files := preload("files.gd")
const Phones := preload("res://addons/lipz/phones.gd")

const _BANKS: Array[String] = [
	"drama", "small", "stripped", "split", "wide", "curves", "faces", "specials", "phones", "rigs", "recorded",
	"dubbed", "long", "variants",
]
## Banks with the answers of a different bank.
const _DUMPS: Dictionary = {"stripped": "small", "split": "small"}
const _TYPES: Dictionary = {"": "unspecified", "blair": "Blair", "toonboom": "ToonBoom", "rms": "Rms"}
const _LONGEST_BYTES := 400
const _START_CHARACTERS := 40
## A string of Godot ends at U+0000, so the text after it is missing in one answer.
const _WITHOUT_NUL: Dictionary = {"    en-us \"nul\\u{0}end\"": "    en-us \"nul\""}

var _out := ""
var _phone_names: Dictionary[int, String] = {}


static func _escaped(text: String) -> String:
	var found := ""
	for character in text:
		var code := character.unicode_at(0)
		var is_control := code < 0x20 or (code >= 0x7F and code < 0xA0)
		if is_control or character in ["\"", "\\", "\u00A0", "\u200B", "\u202F"]:
			found += "\\u{%x}" % code
		else:
			found += character
	return found


static func _quoted(text: String) -> String:
	var bytes := text.to_utf8_buffer()
	if bytes.size() <= _LONGEST_BYTES:
		return "\"%s\"" % _escaped(text)
	var start := _escaped(text.left(_START_CHARACTERS))
	return "\"%s\"... %d bytes, fnv %s" % [start, bytes.size(), fnv(bytes)]


## FNV-1a of 64 bits, in hexadecimal digits.
static func fnv(bytes: PackedByteArray) -> String:
	var found := -3750763034362895579
	for byte in bytes:
		found = (found ^ byte) * 0x100000001B3
	return LipzClip.Hashing.hex(found)


static func _some(value: int) -> String:
	return "Some(%d)" % value if value >= 0 else "None"


## A number as the dumps print it: without zeros at its end.
static func _plain(value: float) -> String:
	var thousandths := roundi(value * 1000.0)
	var text := "%d.%03d" % [absi(thousandths) / 1000, absi(thousandths) % 1000]
	return ("-" if thousandths < 0 else "") + text.rstrip("0").rstrip(".")


func _put_sampled(clip: LipzClip) -> void:
	_out += "  at 24 fps, each 50 ms: "
	var before := -1
	for step in 200:
		var frame := clip.frame_at_ns(step * 50000000)
		var segment := clip.segment_of_frame(frame)
		if segment != before or step == 0:
			if segment >= 0 or before >= 0:
				_out += "[%d]" % segment if segment >= 0 else "[end]"
			before = segment
		if segment < 0:
			break
		_out += clip.viseme(frame)
	_out += "\n"


func _put_mouth(clip: LipzClip) -> void:
	_out += "\nclip %s %s\n" % [clip.key, clip.id()]
	var rate := "Fps(%d/%d)" % [clip.fps_numerator, clip.fps_denominator] if clip.fps_numerator > 0 else "unspecified"
	_out += "  rate %s, type %s\n" % [rate, _TYPES[clip.viseme_type]]
	_out += "  visemes %s, events %s\n" % [clip.has_visemes, clip.has_events]
	var duration := _some(clip.start_of_frame_us(clip.frame_count))
	_out += "  %d frames %s, %s us\n" % [clip.frame_count, clip.frames(), duration]
	_put_sampled(clip.or_fps(24))


func _put_voices(bank: LipzBank, clip: LipzClip) -> void:
	var original := LipzVoices.original_of(clip)
	if original != null:
		_out += "  dub of %s in %s\n" % [original.key, LipzVoices.voice_of(clip)]
		return
	for tag in bank.voices():
		var voiced := LipzVoices.in_voice(clip, tag)
		if voiced.key != clip.key:
			_out += "  in %s %s (%s)\n" % [tag, voiced.key, "Dub" if LipzVoices.voice_of(voiced) == tag else "OtherDub"]


func _put_curves(clip: LipzClip) -> void:
	if clip.recording_hash() != "":
		_out += "  recording %d us, content %s\n" % [roundi(clip.recording_duration() * 1e6), clip.recording_hash()]
	var rated := clip.or_fps(24)
	for curve in clip.curves():
		_out += "  curve " + _quoted(curve.name)
		for index in curve.key_count:
			_out += " %d:%s" % [curve.key_frame(index), _plain(curve.key_value(index))]
		_out += ", each 50 ms:"
		for step in 20:
			_out += " " + _plain(rated.curve(curve.name)._thousandths_at(step * 50000000) / 1000.0)
		_out += "\n"


func _put_faces(clip: LipzClip, profile: FaceProfile) -> void:
	_out += "  face %s, each 150 ms" % _quoted(profile.name)
	for step in 67:
		var face := LipzFace._at_ns(clip, step * 150000000, "", true, Vector2.ZERO, true, profile)
		var values: Array = [
			face.blink, face.head_pitch, face.head_yaw, face.head_roll, face.eye_pitch, face.eye_yaw, face.brows,
			face.shrug, face.breath,
		]
		_out += ": " + " ".join(values.map(_plain))
	_out += "\n"


func _put_articulation(bank: LipzBank, clip: LipzClip, profile: Articulation) -> void:
	var phones: Phones = Phones.of(clip)
	var words := PackedStringArray()
	for index in phones.numbers.size():
		words.append("%s@%d" % [_phone_names.get(phones.numbers[index], "?"), phones.starts_ms[index]])
	var level := "Some(%d)" % phones.level_db if phones.has_level else "None"
	_out += "  phones %s, certain %s, %s dB\n" % [" ".join(words), phones.are_certain, level]
	_out += "  articulation %s, each 50 ms" % _quoted(profile.name)
	for step in 20:
		_out += ": " + " ".join(Array(profile.thousandths(clip, step * 50000000)).map(str))
	_out += "\n"
	for rig in bank.rigs():
		_out += "  rig " + _quoted(rig.name)
		var weights := PackedFloat32Array()
		weights.resize(rig.weight_names.size())
		rig._weights_at_ns(clip, 500000000, weights, "", true, profile)
		for index in weights.size():
			_out += " %s %s" % [rig.weight_names[index], _plain(weights[index])]
		_out += "\n"


func _put_segment(bank: LipzBank, clip: LipzClip, segment: int) -> void:
	var frames := clip.segment_frames(segment)
	var start := _some(clip.start_of_frame_us(frames.x))
	_out += "  segment %d frames %d..%d us %s..%s\n" % [
		segment, frames.x, frames.y, start, _some(clip.start_of_frame_us(frames.y)),
	]
	if clip.has_events:
		_out += "    event %s\n" % _quoted(clip.event(segment))
	for event in clip.events(segment):
		_out += "    typed \"%s\"\n" % _escaped(str(event))
	for locale in bank.locales():
		if clip.has_text(segment, locale):
			var origin := " (fallback)" if clip.is_fallback(segment, locale) else ""
			_out += "    %s %s%s\n" % [locale.tag, _quoted(clip.text(segment, locale)), origin]


func _put_profile(profile: FaceProfile) -> void:
	_out += "face %s, blinks %s ms, each %d, %d %% double, head %d %d, pose %d ms, glances %d %%, fixation %d ms\n" % [
		_quoted(profile.name), " ".join(profile.blink_interval_ms.map(str)), profile.blink_length_ms,
		profile.double_blink_percent, profile.head_motion, profile.head_follows, profile.pose_ms,
		profile.glance_percent, profile.fixation_ms,
	]


func _dump(bank: LipzBank) -> PackedStringArray:
	_out = "format 1, %d clips\n" % bank.clip_count
	for locale in bank.locales():
		_out += "locale %s%s\n" % [locale.tag, " default" if locale.is_default else ""]
	for index in bank.voices().size():
		_out += "voice %s%s\n" % [bank.voices()[index], " original" if index == 0 else ""]
	for profile: FaceProfile in bank.face_profiles():
		_put_profile(profile)
	for clip in bank.clips():
		_put_mouth(clip)
		_put_voices(bank, clip)
		_put_curves(clip)
		for profile: FaceProfile in bank.face_profiles():
			_put_faces(clip, profile)
		for profile: Articulation in bank.articulations():
			_put_articulation(bank, clip, profile)
		for segment in clip.segment_count:
			_put_segment(bank, clip, segment)
	return _out.split("\n")


## Reads the names of the phones from the table of the format.
func _read_phone_names() -> void:
	var is_inside := false
	for line in Files.lines("res://bank-format.md"):
		if line.begins_with("## "):
			is_inside = line == "## Phones"
		var cells := line.split("|")
		if is_inside and cells.size() == 5 and cells[1].strip_edges().is_valid_int():
			var arpabet := cells[2].strip_edges().trim_prefix("`").trim_suffix("`")
			var ipa := cells[3].strip_edges().trim_prefix("`").trim_suffix("`")
			_phone_names[cells[1].to_int()] = arpabet if arpabet != "" else ipa


## Compares all dumps. Returns their number, or a message about the first difference.
func compare_all() -> String:
	_read_phone_names()
	for bank_name in _BANKS:
		var bank := Files.bank(bank_name)
		if bank_name == "split":
			bank.open_texts(Files.golden("split.de-de.lipztexts"))
			bank.open_texts(Files.golden("split.en-us.lipztexts"))
		var path: String = "res://fixtures/banks/v1/%s.dump" % _DUMPS.get(bank_name, bank_name)
		var expected := Files.lines(path)
		for index in expected.size():
			expected[index] = _WITHOUT_NUL.get(expected[index], expected[index])
		var problem := Files.difference(bank_name + ".dump", _dump(bank), expected)
		if problem != "":
			return problem
	return "%d banks" % _BANKS.size()
