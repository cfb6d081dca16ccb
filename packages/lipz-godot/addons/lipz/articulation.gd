@tool
extends RefCounted
## Articulation: how far jaw, lips and tongue are from rest. An articulation profile of a bank, or the built-in one.

const Blend := preload("blend.gd")
const Clock := preload("clock.gd")
const Phones := preload("phones.gd")
const Section := preload("section.gd")
const Targets := preload("targets.gd")

const NAMES: Array[String] = [
	"jaw", "opening", "closure", "teeth", "rounding", "spreading", "tongue_tip", "tongue_out", "tongue_back",
]
const _RECORD_BYTES := 16
const _GAIN_PER_DB := 35
const _REACH_MS := 150
const _MOST_MS := 400
const _MOST_US := 400000
const _MOST_NEAR := 24
const _GLIDE_PERCENT := 55
const _SHORTEST_GLIDE_US := 30000
const _LONGEST_FRAME_US := 1000000

var name := "default"
var gain_percent := 100
var jaw_percent := 100
## Milliseconds by which the mouth is ahead of the audio.
var lead_ms := 10
var level_db := -20
## The offset after the profile in its section, in bytes.
var end_bytes := 0
var _targets: Array[PackedByteArray] = []
var _rest := Targets.rest
var _blend := Blend.new()


## Reads the profile at an offset of a section; null if it is damaged.
static func read(section: Section, at: int) -> Variant:
	var name_length := section.u16(at)
	var count := section.u16(at + 2)
	var first := at + _RECORD_BYTES + name_length
	if name_length < 0 or count < 0 or not section.has_bytes(first, count * Targets.BYTES):
		return null
	var profile := new()
	profile.name = section.text(at + _RECORD_BYTES, name_length)
	profile.gain_percent = section.u16(at + 4)
	profile.jaw_percent = section.u16(at + 6)
	profile.lead_ms = section.i16(at + 8)
	profile.level_db = section.i16(at + 10)
	profile.end_bytes = first + count * Targets.BYTES
	profile._targets = Targets.list(section, first, count)
	if count > 0:
		profile._rest = profile._targets[0]
	return profile


## Returns the nine values of a clip at a time in thousandths, in the order of [constant NAMES].
func thousandths(clip: LipzClip, time_ns: int) -> PackedInt64Array:
	var values := PackedInt64Array()
	values.resize(NAMES.size())
	write(clip, time_ns, values)
	return values


## Writes these values to the start of an array.
func write(clip: LipzClip, time_ns: int, values: PackedInt64Array) -> void:
	var phones: Phones = Phones.of(clip)
	_blend.start(phones.are_certain)
	if phones.numbers.is_empty():
		_add_visemes(clip, time_ns)
	else:
		_add_phones(phones, time_ns)
	_blend.finish(_rest, _gain(phones), jaw_percent, values)
	if clip.fps_numerator > 0 and not clip.curves().is_empty():
		_replace(clip, time_ns, values)


## Replaces values by the curves with their names.
func _replace(clip: LipzClip, time_ns: int, values: PackedInt64Array) -> void:
	for curve in clip.curves():
		var index := NAMES.find(curve.name)
		if index >= 0:
			values[index] = clampi(curve._thousandths_at(time_ns), 0, 1000)


func _gain(phones: Phones) -> int:
	var louder_db := phones.level_db - level_db if phones.has_level else 0
	return int(clampi(louder_db * _GAIN_PER_DB + 1000, 700, 1300) * gain_percent / 100.0)


func _target(number: int) -> PackedByteArray:
	return _targets[number] if number < _targets.size() else Targets.rest


func _add_phones(phones: Phones, time_ns: int) -> void:
	var ms := -_MOST_MS
	var us := 0
	if time_ns >= 0:
		ms = Clock.milliseconds(time_ns) + lead_ms
		@warning_ignore("integer_division")
		us = (time_ns % 1000000 * 65536 / 1000000) * 1000 >> 16
	var count := phones.numbers.size()
	var starts := phones.starts_ms
	var first := starts.bsearch(maxi(ms - _REACH_MS, 0), false) - 1
	first = clampi(first, 0, count - 1)
	var last_ms := maxi(ms + _REACH_MS, 0)
	for index in range(first, mini(first + _MOST_NEAR, count)):
		if starts[index] > last_ms:
			return
		var number := phones.numbers[index]
		if number == 0:
			continue
		var target := _target(number)
		var start_us := clampi(starts[index] - ms, -_MOST_MS, _MOST_MS) * 1000 - us
		var end_ms := starts[index + 1] if index + 1 < count else phones.end_ms
		var end_us := clampi(end_ms - ms, -_MOST_MS, _MOST_MS) * 1000 - us
		if target[Targets.SECOND] != number and end_us - start_us > _SHORTEST_GLIDE_US:
			var glide_us := start_us + int((end_us - start_us) * _GLIDE_PERCENT / 100.0)
			_blend.add(start_us, glide_us, target)
			_blend.add(glide_us, end_us, _target(target[Targets.SECOND]))
		else:
			_blend.add(start_us, end_us, target)


func _add_visemes(clip: LipzClip, time_ns: int) -> void:
	if clip.fps_numerator == 0 or clip.viseme_type == "" or time_ns < 0:
		return
	if clip._targets.is_empty():
		clip._targets = Targets.of_visemes(clip.viseme_type)
	var targets := clip._targets
	var codes := clip.frames()
	var position := Clock.position(time_ns, clip.fps_numerator, clip.fps_denominator)
	var frame := position >> 16
	var frame_us := clampi(clip.start_of_frame_us(1), 1, _LONGEST_FRAME_US)
	var reach := int(_MOST_US / float(frame_us)) + 1
	var start := maxi(frame - reach, 0)
	var last := mini(frame + reach, codes.length())
	var start_us := -((frame - start) * frame_us + (frame_us * ((position & 0xFFFF) >> 4) >> 12))
	while start < last:
		var code := codes[start]
		var end := start + 1
		while end < last and codes[end] == code:
			end += 1
		var end_us := start_us + (end - start) * frame_us
		if code != LipzClip.REST:
			_blend.add(start_us, end_us, targets[code] if targets.has(code) else targets[""])
		start = end
		start_us = end_us
