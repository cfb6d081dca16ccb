@tool
class_name LipzCurve
extends RefCounted
## A curve of a clip: a named number that changes while the clip plays. Get it with [method LipzClip.curve].

const Clock := preload("clock.gd")
const Section := preload("section.gd")

const _RECORD_BYTES := 8
const _UNIT_BYTES := 4
const _WIDE := 0x80000000

var name := ""
var key_count := 0
var _clip: WeakRef
## The frames of the keys, and their values in thousandths.
var _frames := PackedInt64Array()
var _values := PackedInt64Array()


## Returns the index of the record of a slot, among records of 8 bytes in ascending order; -1 without one.
static func _find_slot(records: Section, slot: int) -> int:
	var low := 0
	var high := records.length >> 3
	while low < high:
		var middle := (low + high) >> 1
		if records.u32(middle * _RECORD_BYTES) < slot:
			low = middle + 1
		else:
			high = middle
	return low if records.u32(low * _RECORD_BYTES) == slot else -1


static func _list(clip: LipzClip) -> Array[LipzCurve]:
	var list: Array[LipzCurve] = []
	var clips := clip.bank._file.section("CRVC")
	var curves := clip.bank._file.section("CURV")
	var found := _find_slot(clips, clip.slot)
	if found < 0:
		return list
	var count := curves.length >> 3
	var last := clips.u32((found + 1) * _RECORD_BYTES + 4)
	for index in range(clips.u32(found * _RECORD_BYTES + 4), mini(last if last >= 0 else count, count)):
		var curve := _read(clip, curves, index)
		if curve == null:
			break
		list.append(curve)
	return list


static func _read(clip: LipzClip, curves: Section, index: int) -> LipzCurve:
	var keys := clip.bank._file.section("CRVK")
	var first := curves.u32(index * _RECORD_BYTES) * _UNIT_BYTES
	var name_and_width := curves.u32(index * _RECORD_BYTES + 4)
	var next := curves.u32((index + 1) * _RECORD_BYTES)
	var last := next * _UNIT_BYTES if next >= 0 else keys.length - keys.length % _UNIT_BYTES
	if not clip.bank._events.has_name(name_and_width & ~_WIDE) or not keys.has_bytes(first, last - first):
		return null
	var curve := LipzCurve.new()
	curve._clip = weakref(clip)
	curve.name = clip.bank._events.name_of(name_and_width & ~_WIDE)
	var is_wide := name_and_width & _WIDE != 0
	var key_bytes := 8 if is_wide else 4
	for at in range(first, last - key_bytes + 1, key_bytes):
		curve._frames.append(keys.u32(at) if is_wide else keys.u16(at))
		curve._values.append(keys.i32(at + 4) if is_wide else keys.i16(at + 2))
	curve.key_count = curve._frames.size()
	return curve


## Returns the frame of a key, from 0.
func key_frame(index: int) -> int:
	return _frames[index]


## Returns the value of a key, from 0.
func key_value(index: int) -> float:
	return _values[index] / 1000.0


## Returns the value at the start of a frame.
func value(frame: int) -> float:
	return _thousandths(frame << 16) / 1000.0


## Returns the value at a time; 0 without a frame rate.
func value_at(seconds: float) -> float:
	return _thousandths_at(Clock.of_seconds(seconds)) / 1000.0


func _thousandths_at(time_ns: int) -> int:
	var clip: LipzClip = _clip.get_ref()
	if clip == null or clip.fps_numerator == 0:
		return 0
	return _thousandths(Clock.position(time_ns, clip.fps_numerator, clip.fps_denominator))


## Returns the index of the last key at or before a frame; 0 if there is none.
func _index_at(frame: int) -> int:
	var found := _frames.bsearch(frame, false) - 1
	return maxi(found, 0)


## Returns the value in thousandths at a position in 1/65,536 of a frame.
func _thousandths(position: int) -> int:
	if key_count == 0:
		return 0
	var frame := position >> 16
	var index := _index_at(frame)
	var before := _frames[index]
	var from := _values[index]
	if frame < before or index + 1 >= key_count or _frames[index + 1] <= frame:
		return from
	var distance := _values[index + 1] - from
	var whole := (_frames[index + 1] - before) << 16
	var part := _share(absi(distance), position - (before << 16), whole)
	return from + part if distance > 0 else from - part


## Returns distance * done / whole, rounded to the nearest, a half upwards.
static func _share(distance: int, done: int, whole: int) -> int:
	if distance < 0x20000 and whole < 0x100000000000:
		@warning_ignore("integer_division")
		return (2 * distance * done + whole) / (2 * whole)
	var quotient := 0
	var rest := 0
	for bit in range(32, -1, -1):
		quotient *= 2
		rest *= 2
		if rest >= whole:
			rest -= whole
			quotient += 1
		if distance >> bit & 1:
			rest += done
			if rest >= whole:
				rest -= whole
				quotient += 1
	return quotient + 1 if 2 * rest >= whole else quotient


## Of two values, returns the one that is farther from neutral.
static func _farther(one: int, other: int, neutral: int) -> int:
	return other if absi(other - neutral) > absi(one - neutral) else one


## Returns the curves of a character of a clip, by their names without that of the character. Each name has the curve
## without and the curve with the character's name, or one of them.
static func _of_character(clip: LipzClip, character: String, is_speaker: bool) -> Dictionary[String, Array]:
	var kept := clip._speaker_curves if is_speaker or character == "" else clip._other_curves
	if kept.has(character):
		return kept[character]
	var found: Dictionary[String, Array] = {}
	var prefix := character + "."
	for curve in clip.curves():
		var is_named := character != "" and curve.name.begins_with(prefix)
		if not is_named and character != "" and not is_speaker:
			continue
		var purpose := curve.name.trim_prefix(prefix) if is_named else curve.name
		if not found.has(purpose):
			found[purpose] = []
		found[purpose].append(curve)
	kept[character] = found
	return found


## Returns the value in thousandths of one of the curves of [method _of_character], which are not empty.
static func _strongest(curves: Array, position: int, neutral: int) -> int:
	var first: LipzCurve = curves[0]
	var found := first._thousandths(position)
	for index in range(1, curves.size()):
		var other: LipzCurve = curves[index]
		found = _farther(found, other._thousandths(position), neutral)
	return found
