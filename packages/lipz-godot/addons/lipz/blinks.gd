@tool
extends RefCounted
## The blinks of a face. Keeps those of the last slots, because most queries are about the same ones.

const Chance := preload("chance.gd")
const Emotions := preload("emotions.gd")
const FaceProfile := preload("face_profile.gd")

var _profile: FaceProfile
var _id: int
## The different intervals, and for each of them: the phase, the last slot that was computed, and for this slot and
## the one before it the start of the blink in milliseconds (-1 before the clip) and whether it is a double blink.
var _intervals := PackedInt64Array()
var _phases := PackedInt64Array()
var _slots := PackedInt64Array()
var _starts := PackedInt64Array()
var _doubles := PackedInt64Array()
## The lids are open from one time up to another one, in milliseconds.
var _open_from_ms := 0
var _open_until_ms := 0


func _init(profile: FaceProfile, id: int) -> void:
	_profile = profile
	_id = id
	for interval in profile.blink_interval_ms:
		if interval > 0 and not _intervals.has(interval):
			_intervals.append(interval)
			_phases.append(Chance.part(interval, Chance.draw(id, Chance.Stream.BLINK_PHASE, interval, 0)))
			_slots.append(-1)
	_starts.resize(_intervals.size() * 2)
	_doubles.resize(_intervals.size() * 2)


## Returns how far the lids are closed, in thousandths. The clip is null for a silent character.
func closed(ms: int, clip: LipzClip, character: String, is_speaker: bool) -> int:
	if ms >= _open_from_ms and ms < _open_until_ms:
		return 0
	var most := 0
	var until_ms := 0x7FFFFFFFFFFFFFFF
	for index in _intervals.size():
		var slot := int((ms + _phases[index]) / float(_intervals[index]))
		if slot != _slots[index]:
			_slots[index] = slot
			_compute(index, 0, slot)
			_compute(index, 1, slot - 1)
		until_ms = mini(until_ms, (slot + 1) * _intervals[index] - _phases[index])
		for place in range(index * 2, index * 2 + 2):
			var start := _starts[place]
			if start > ms:
				until_ms = mini(until_ms, start)
			elif start >= 0 and ms - start < 3 * _profile.blink_length_ms:
				until_ms = ms
				var found := _closed_after(ms - start, _doubles[place] != 0)
				if found > most and _interval_at(start, clip, character, is_speaker) == _intervals[index]:
					most = found
	_open_from_ms = ms
	_open_until_ms = until_ms
	return most


func _compute(index: int, which: int, slot: int) -> void:
	var interval := _intervals[index]
	var place := index * 2 + which
	_starts[place] = -1
	if slot < 0:
		return
	var late := Chance.part(interval >> 1, Chance.draw(_id, Chance.Stream.BLINK_TIME, interval, slot))
	_starts[place] = slot * interval + (interval >> 2) + late - _phases[index]
	var drawn := Chance.part(100, Chance.draw(_id, Chance.Stream.DOUBLE_BLINK, interval, slot))
	_doubles[place] = 1 if drawn < _profile.double_blink_percent else 0


func _closed_after(passed: int, is_double: bool) -> int:
	var length := _profile.blink_length_ms
	var again := length + (length >> 1)
	if is_double and passed >= again:
		passed -= again
	if passed < length >> 2:
		return int(passed * 1000 / float(length >> 2))
	if passed < length >> 1:
		return 1000
	return int(maxi(length - passed, 0) * 1000 / float(length - (length >> 1)))


func _interval_at(ms: int, clip: LipzClip, character: String, is_speaker: bool) -> int:
	var strongest := -1
	if clip != null:
		strongest = Emotions.strongest(Emotions.thousandths(clip, ms * 1000000, character, is_speaker))
	return _profile.blink_interval_ms[strongest + 1]


## Returns the blinks of a seed, which the clip keeps until a query has a different profile.
static func of(clip: LipzClip, profile: FaceProfile, id: int) -> RefCounted:
	if not clip._blinks.has(id) or clip._blinks[id]._profile != profile:
		clip._blinks[id] = new(profile, id)
	return clip._blinks[id]
