@tool
class_name LipzClip
extends RefCounted
## A clip: one spoken line. Get it with [method LipzBank.clip]. Frames and segments are numbered from 0. Times are in
## seconds; the methods that end in `_ns` take nanoseconds from [code]clock.gd[/code].

const Blinks := preload("blinks.gd")
const Clock := preload("clock.gd")
const Emotions := preload("emotions.gd")
const Hashing := preload("hashing.gd")
const Phones := preload("phones.gd")

const REST := "-"
const _RECORD_BYTES := 16
const _MAX_INTEGER_FPS := 1000
const _NO_RATE := 0xFFFF
const _NO_RECORDING := -1
const _VISEME_TYPES: Array[String] = ["", "blair", "toonboom", "rms"]
## The openness of each viseme, from 0 to 9. All others are 0.
const _OPENNESS: Dictionary = {
	"blair": {"A": 9, "E": 6, "O": 6, "L": 4, "S": 3, "U": 2, "W": 2, "F": 1},
	"toonboom": {"D": 9, "C": 6, "E": 6, "B": 3, "F": 2, "G": 1},
	"rms": {"1": 1, "2": 2, "3": 3, "4": 4, "5": 5, "6": 6, "7": 7, "8": 8, "9": 9},
}
const _OPENNESS_OF_DIGIT := 0.11

## The key, such as `act1/mara-good-evening`.
var key := ""
var frame_count := 0
var segment_count := 0
## `blair`, `toonboom`, `rms`, or empty if it is unspecified.
var viseme_type := ""
## Whether the clip's file has visemes, which may be without frames.
var has_visemes := false
var has_events := false
## The frame rate in lowest terms; 0 if it is unspecified.
var fps_numerator := 0
var fps_denominator := 1
var bank: LipzBank
var slot := 0
var _id := 0
var _frames_first := 0
var _segments_first := 0
## The visemes as strings, one for each frame, read by the first query.
var _visemes := ""
var _starts := PackedInt64Array()
var _curves: Array[LipzCurve] = []
var _has_curves := false
# What queries in other scripts have read: phones, the targets of the visemes by their codes, and the curves and
# blinks of each character.
@warning_ignore("unused_private_class_variable")
var _phones: Phones
@warning_ignore("unused_private_class_variable")
var _targets: Dictionary[String, PackedByteArray] = {}
@warning_ignore("unused_private_class_variable")
var _speaker_curves: Dictionary[String, Dictionary] = {}
@warning_ignore("unused_private_class_variable")
var _other_curves: Dictionary[String, Dictionary] = {}
@warning_ignore("unused_private_class_variable")
var _blinks: Dictionary[int, Blinks] = {}


## Returns the clip in a slot; null if the bank does not have it.
static func _of(of_bank: LipzBank, of_slot: int) -> LipzClip:
	var records := of_bank._file.section("CLIP")
	var keys := of_bank._file.section("KEYS")
	var at := of_slot * _RECORD_BYTES
	if of_slot < 0 or not records.has_bytes(at, _RECORD_BYTES) or not keys.has_bytes(at, _RECORD_BYTES):
		return null
	var clip := LipzClip.new()
	clip.bank = of_bank
	clip.slot = of_slot
	clip._frames_first = records.u32(at)
	clip.frame_count = records.u32(at + 4)
	clip._segments_first = records.u32(at + 8)
	clip._read_rate(records.u16(at + 12))
	var type := records.u8(at + 14)
	clip.viseme_type = _VISEME_TYPES[type] if type < _VISEME_TYPES.size() else ""
	clip.has_visemes = records.u8(at + 15) & 1 != 0
	clip.has_events = of_bank._events.has_events(clip._segments_first)
	clip._id = keys.u64(at)
	clip.key = of_bank._file.section("NAME").text(keys.u32(at + 8), keys.u16(at + 12))
	clip.segment_count = mini(keys.u16(at + 14), of_bank._file.section("STRT").length >> 2)
	return clip


func _read_rate(rate: int) -> void:
	if rate == 0 or rate == _NO_RATE:
		return
	if rate <= _MAX_INTEGER_FPS:
		fps_numerator = rate
		return
	var rates := bank._file.section("RATE")
	var at := (rate - _MAX_INTEGER_FPS - 1) * _RECORD_BYTES
	var numerator := rates.u32(at + 8)
	var denominator := rates.u32(at + 12)
	if denominator > 0 and numerator >= denominator and numerator <= denominator * _MAX_INTEGER_FPS:
		fps_numerator = numerator
		fps_denominator = denominator


## The clip id: 16 hexadecimal digits.
func id() -> String:
	return Hashing.hex(_id)


## Returns the clip with this frame rate, if its file does not specify one. The rate is between 1 and 1,000.
func or_fps(numerator: int, denominator := 1) -> LipzClip:
	if fps_numerator > 0:
		return self
	var clip := _copy()
	clip.fps_numerator = numerator
	clip.fps_denominator = denominator
	return clip


## Returns the clip with this viseme type, if its file does not specify one.
func or_viseme_type(type: String) -> LipzClip:
	if viseme_type != "":
		return self
	var clip := _copy()
	clip.viseme_type = type
	return clip


func _copy() -> LipzClip:
	var clip := _of(bank, slot)
	clip.fps_numerator = fps_numerator
	clip.fps_denominator = fps_denominator
	clip.viseme_type = viseme_type
	return clip


## Returns the length in seconds; 0 without a frame rate.
func duration() -> float:
	return start_of_frame_us(frame_count) / 1e6 if fps_numerator > 0 else 0.0


## Returns the first microsecond of a frame; -1 without a frame rate.
func start_of_frame_us(frame: int) -> int:
	return Clock.start_of_frame_us(frame, fps_numerator, fps_denominator) if fps_numerator > 0 else -1


## Returns the codes of all frames, one character each.
func frames() -> String:
	if _visemes == "" and frame_count > 0:
		_visemes = bank._file.section("FRAM").slice(_frames_first, frame_count).get_string_from_ascii()
	return _visemes


## Returns the frame at a time; -1 outside the clip.
func frame_at(seconds: float) -> int:
	return frame_at_ns(Clock.of_seconds(seconds))


func frame_at_ns(time_ns: int) -> int:
	if fps_numerator == 0:
		return -1
	var frame := Clock.frame(time_ns, fps_numerator, fps_denominator)
	return frame if frame < frame_count else -1


## Returns the viseme of a frame, one character; `-`, rest, outside the clip.
func viseme(frame: int) -> String:
	if frame < 0 or frame >= frame_count:
		return REST
	var codes := frames()
	return codes[frame] if frame < codes.length() else REST


## Returns the viseme at a time.
func viseme_at(seconds: float) -> String:
	return viseme(frame_at_ns(Clock.of_seconds(seconds)))


## Returns how far the mouth is open in a viseme, from 0 to 0.99; -1 for clips without frames or viseme type.
func openness(of_viseme: String) -> float:
	if frame_count == 0 or viseme_type == "":
		return -1.0
	var digits: Dictionary = _OPENNESS[viseme_type]
	return digits.get(of_viseme, 0) * _OPENNESS_OF_DIGIT


## Reads the starts of the segments, and the start after them.
func _read_starts() -> void:
	var section := bank._file.section("STRT")
	for segment in segment_count + 1:
		var start := section.u32((_segments_first + segment) * 4)
		if start < 0:
			break
		_starts.append(start)


## Returns the segment of a frame; -1 outside the clip.
func segment_of_frame(frame: int) -> int:
	if frame < 0 or frame >= frame_count:
		return -1
	if _starts.is_empty():
		_read_starts()
	if segment_count == 0 or _starts.size() < segment_count:
		return -1
	var low := 0
	var high := segment_count - 1
	var offset := _frames_first + frame
	while low < high:
		var middle := (low + high) >> 1
		if _starts[middle + 1] <= offset:
			low = middle + 1
		else:
			high = middle
	return low


## Returns the segment at a time; -1 outside the clip.
func segment_at(seconds: float) -> int:
	return segment_of_frame(frame_at(seconds))


## Whether the clip has a segment with this number.
func has_segment(segment: int) -> bool:
	return segment >= 0 and segment < segment_count


## Returns the first frame of a segment, and the frame after its last one; 0 and 0 outside the clip.
func segment_frames(segment: int) -> Vector2i:
	if _starts.is_empty():
		_read_starts()
	if not has_segment(segment) or segment + 1 >= _starts.size():
		return Vector2i.ZERO
	return Vector2i(maxi(_starts[segment] - _frames_first, 0), maxi(_starts[segment + 1] - _frames_first, 0))


## Returns the text of a segment in a language; empty without a text, and outside the clip.
func text(segment: int, locale: LipzLocale) -> String:
	if not has_segment(segment) or locale == null:
		return ""
	return locale._text(_segments_first, _segments_first + segment)


## Whether a segment has a text in a language, which may be empty.
func has_text(segment: int, locale: LipzLocale) -> bool:
	return has_segment(segment) and locale != null and locale._entry(_segments_first, _segments_first + segment) >= 0


## Whether the text of a segment is from a different language.
func is_fallback(segment: int, locale: LipzLocale) -> bool:
	return has_segment(segment) and locale != null and locale._is_fallback(_segments_first, _segments_first + segment)


## Returns the event string of a segment; empty without events, and outside the clip.
func event(segment: int) -> String:
	return bank._events.string_of(_segments_first + segment) if has_segment(segment) else ""


## Returns the typed events of a segment, in order; an empty list outside the clip.
func events(segment: int) -> Array[LipzEvent]:
	var list: Array[LipzEvent] = []
	if has_segment(segment):
		bank._events.collect(_segments_first + segment, bank._events.NO_NAME, list)
	return list


## Returns the length in seconds of the recording that the clip was made for; -1 if the bank does not have it.
func recording_duration() -> float:
	var length_us := _recording(0)
	return length_us / 1e6 if length_us != _NO_RECORDING else -1.0


## Returns the content hash of the recording, 16 hexadecimal digits; empty if the bank does not have it.
func recording_hash() -> String:
	return Hashing.hex(_recording(8)) if _recording(0) != _NO_RECORDING else ""


func _recording(at: int) -> int:
	var section := bank._file.section("RCRD")
	if not section.has_bytes(slot * _RECORD_BYTES, _RECORD_BYTES):
		return _NO_RECORDING
	return section.u64(slot * _RECORD_BYTES + at)


## Returns a cursor before the start of the audio; null without a frame rate (see [method or_fps]).
func cursor(speaker := "") -> LipzCursor:
	return LipzCursor._of(self, speaker) if fps_numerator > 0 else null


## Returns all curves, in the order of their names.
func curves() -> Array[LipzCurve]:
	if not _has_curves:
		_has_curves = true
		_curves = LipzCurve._list(self)
	return _curves


## Returns the curve with a name; null if the clip does not have it.
func curve(curve_name: String) -> LipzCurve:
	for found in curves():
		if found.name == curve_name:
			return found
	return null


## Returns the articulation at a time: `jaw`, `opening`, `closure`, `teeth`, `rounding`, `spreading`, `tongue_tip`,
## `tongue_out` and `tongue_back`, each from 0 to 1.
func articulation_at(seconds: float) -> Dictionary[String, float]:
	var profile := bank._usual_articulation()
	var values := profile.thousandths(self, Clock.of_seconds(seconds))
	var found: Dictionary[String, float] = {}
	for index in values.size():
		found[profile.NAMES[index]] = values[index] / 1000.0
	return found


## Returns the emotions of a character at a time: a value, usually from 0 to 10, for each emotion that is not 0. The
## character is the speaker, unless you pass a name. With `is_speaker`, the name is that of the speaker.
func emotions_at(seconds: float, character := "", is_speaker := false) -> Dictionary[String, float]:
	return Emotions.named(Emotions.thousandths(self, Clock.of_seconds(seconds), character, is_speaker))
