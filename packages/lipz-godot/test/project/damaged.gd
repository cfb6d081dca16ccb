extends RefCounted
## The damaged banks of fixtures/banks/damaged.txt: each must give the documented error, and all queries of a bank
## that opens must end.

const Dumps := preload("dumps.gd")
const Files := preload("files.gd")

const _FEATURES: Array[String] = ["text-banks", "checksum"]
## Every query of a bank with a changed byte takes long, so only some of these banks get them.
const _QUERIED_EACH := 29

var _bytes: PackedByteArray
var _damage: Array[PackedStringArray] = []


static func _put(bytes: PackedByteArray, at: int, hex: String) -> void:
	var new_bytes := hex.hex_decode()
	bytes.resize(maxi(bytes.size(), at + new_bytes.size()))
	for index in new_bytes.size():
		bytes[at + index] = new_bytes[index]


## Returns the offset of the directory entry of a section of an undamaged file.
static func _entry_of(bytes: PackedByteArray, tag: String) -> int:
	for at in range(64, bytes.size() - 16, 16):
		if bytes.slice(at, at + 4).get_string_from_ascii() == tag:
			return at
	return -1


func _damaged(undamaged: PackedByteArray) -> PackedByteArray:
	var bytes := undamaged.duplicate()
	for words in _damage:
		match words[0]:
			"cut":
				bytes.resize(mini(words[1].to_int(), bytes.size()))
			"append":
				_put(bytes, bytes.size(), words[1])
			"put":
				_put(bytes, words[1].to_int(), words[2])
			"entry":
				_put(bytes, _entry_of(undamaged, words[1]) + words[2].to_int(), words[3])
			"section":
				var start := undamaged.decode_u32(_entry_of(undamaged, words[1]) + 4)
				_put(bytes, start + words[2].to_int(), words[3])
	return bytes


static func _said(problem: Dictionary) -> String:
	return "opens" if problem.is_empty() else "%s at %d" % [problem.kind, problem.offset_bytes]


## Makes every query.
static func _query(bank: LipzBank) -> void:
	bank.clip("act1/blair")
	bank.default_locale()
	bank.babble().at(1.0, 0.5)
	for clip in bank.clips():
		var rated := clip.or_fps(24).or_viseme_type("blair")
		rated.frames()
		rated.recording_duration()
		LipzVoices.in_voice(rated, "de-de")
		for segment in mini(clip.segment_count, 20):
			clip.segment_frames(segment)
			clip.event(segment)
			clip.events(segment)
			for locale in bank.locales():
				clip.text(segment, locale)
		var cursor := rated.cursor("amy")
		cursor.hold = 3
		cursor.lead_us = 40000
		for step in 4:
			_query_at(bank, rated, cursor, step * 0.1)
		cursor.loop_to(0.0)
		cursor.finish()
		cursor.characters()


static func _query_at(bank: LipzBank, clip: LipzClip, cursor: LipzCursor, seconds: float) -> void:
	cursor.advance_to(seconds)
	cursor.viseme()
	clip.emotions_at(seconds, "mara")
	LipzFace.at(clip, seconds)
	bank.articulation().thousandths(clip, 0)
	for curve in clip.curves():
		curve.value_at(seconds)
	for rig in bank.rigs():
		var weights := PackedFloat32Array()
		weights.resize(rig.weight_names.size())
		rig.weights_at(clip, seconds, weights)


func _each_byte() -> String:
	var opened := 0
	var refused := 0
	var lines := ""
	for at in _bytes.size():
		_bytes[at] = ~_bytes[at] & 0xFF
		var problem := LipzBank.problem_of(_bytes)
		if problem.is_empty():
			opened += 1
			if at % _QUERIED_EACH == 0:
				_query(LipzBank.open(_bytes.duplicate()))
		else:
			refused += 1
			lines += "%d: %s\n" % [at, _said(problem)]
		_bytes[at] = ~_bytes[at] & 0xFF
	return "%d open, %d refused, fnv %s" % [opened, refused, Dumps.fnv(lines.to_utf8_buffer())]


## Returns the answer of a command that opens; empty for one that damages.
func _answer(words: PackedStringArray) -> String:
	match words[0]:
		"open":
			var bytes := _damaged(_bytes)
			var problem := LipzBank.problem_of(bytes)
			if problem.is_empty():
				_query(LipzBank.open(bytes))
			return _said(problem)
		"verify":
			return "verified" if LipzBank.open(_damaged(_bytes)).verify_checksum() else "Checksum at 8"
		"texts":
			var texts := _damaged(Files.golden(words[1] + ".lipztexts"))
			return _said(LipzBank.open(_bytes).problem_of_texts(texts))
		"each-byte":
			return _each_byte()
	return ""


## Opens all damaged banks. Returns the number of commands, or a message about the first difference.
func open_all() -> String:
	var expected := Files.lines("res://fixtures/banks/damaged.txt")
	var answers := PackedStringArray()
	var run := 0
	var skipped := 0
	var is_skipping := false
	for line in expected:
		var is_answer := line.begins_with("  ")
		if not is_answer or is_skipping:
			answers.append(line)
		var words := line.split(" ")
		if words[0] == "##":
			is_skipping = false
		if words[0] == "needs":
			for feature in words.slice(1):
				is_skipping = is_skipping or not feature in _FEATURES
		elif not is_answer and line != "" and not line.begins_with("#"):
			run += 0 if is_skipping else 1
			skipped += 1 if is_skipping else 0
			if not is_skipping:
				_run(words, answers)
	var problem := Files.difference("damaged.txt", answers, expected)
	return problem if problem != "" else "%d commands, %d skipped" % [run, skipped]


func _run(words: PackedStringArray, answers: PackedStringArray) -> void:
	if words[0] == "bank":
		_bytes = Files.golden(words[1] + ".lipzbank")
		_damage.clear()
		return
	var found := _answer(words)
	if found == "":
		_damage.append(words)
	else:
		answers.append("  " + found)
