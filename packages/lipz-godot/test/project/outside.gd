extends RefCounted
## Queries outside a clip, which must not return the data of its neighbours in the bank, and changed files.

const Files := preload("files.gd")

var _problems := PackedStringArray()


func _expect(what: String, found: Variant, expected: Variant) -> void:
	if found != expected:
		_problems.append("FAILED %s: %s instead of %s" % [what, found, expected])


func _test_segments(bank: LipzBank, clip: LipzClip) -> void:
	for segment: int in [-2, -1, clip.segment_count, clip.segment_count + 1, 1 << 30]:
		var name := "%s, segment %d" % [clip.key, segment]
		_expect(name, [clip.has_segment(segment), clip.event(segment), clip.events(segment).size()], [false, "", 0])
		_expect("frames of " + name, clip.segment_frames(segment), Vector2i.ZERO)
		for locale in bank.locales():
			var answers := [clip.text(segment, locale), clip.has_text(segment, locale), clip.is_fallback(segment, locale)]
			_expect("%s in %s" % [name, locale.tag], answers, ["", false, false])


func _test_frames(clip: LipzClip) -> void:
	for frame: int in [-2, -1, clip.frame_count, clip.frame_count + 1]:
		_expect("%s, frame %d" % [clip.key, frame], [clip.segment_of_frame(frame), clip.viseme(frame)], [-1, "-"])
	var rated := clip.or_fps(24)
	for seconds: float in [-1.0, rated.duration()]:
		_expect("%s at %f s" % [clip.key, seconds], [rated.frame_at(seconds), rated.segment_at(seconds)], [-1, -1])


func _test_indices(bank: LipzBank) -> void:
	_expect("clips outside", [bank.clip_at(-1), bank.clip_at(bank.clip_count)], [null, null])


## Returns the contents of a file whose last byte has changed, which only the checksum covers.
static func _changed(file_name: String) -> PackedByteArray:
	var bytes := Files.golden(file_name)
	bytes[-1] ^= 1
	return bytes


func _test_changed_files() -> void:
	_expect("a changed bank", load("res://changed.lipzbank"), null)
	_expect("a changed bank from bytes", LipzBank.open(_changed("drama.lipzbank")).verify_checksum(), false)
	_expect("a bank from bytes", LipzBank.open(Files.golden("drama.lipzbank")).verify_checksum(), true)
	for tag: String in ["de-de", "en-us"]:
		var name := "split.%s.lipztexts" % tag
		_expect(name, LipzBank.verify_texts(Files.golden(name)), true)
		_expect("changed " + name, LipzBank.verify_texts(_changed(name)), false)
		_expect("cut " + name, LipzBank.verify_texts(Files.golden(name).slice(0, 20)), false)


## Runs all tests. Returns the number of clips, or messages about failures.
func run() -> String:
	var count := 0
	for bank_name: String in ["drama", "small", "wide"]:
		var bank := Files.bank(bank_name)
		for clip in bank.clips():
			_test_segments(bank, clip)
			_test_frames(clip)
			count += 1
		_test_indices(bank)
	_test_changed_files()
	return "\n".join(_problems.slice(0, 20)) if not _problems.is_empty() else "%d clips" % count
