@tool
class_name LipzRig
extends RefCounted
## A rig of a bank: the weights of a model's shapes at a time. Get it with [method LipzBank.rig].

const Articulation := preload("articulation.gd")
const Blinks := preload("blinks.gd")
const Clock := preload("clock.gd")
const Hashing := preload("hashing.gd")
const Section := preload("section.gd")

const _RECORD_BYTES := 8
const _WEIGHT_BYTES := 8
const _TERM_BYTES := 4
const _NO_INPUT := 255
const _INPUTS := 25
const _MOST_INPUT := 4000
const _BLINK := 21
## The input of each curve; -1 for the one that is combined with blinks.
const _CURVE_INPUTS: Dictionary[String, int] = {
	"sadness": 9, "anger": 10, "joy": 11, "fear": 12, "disgust": 13, "surprise": 14, "shock": 15, "perplexed": 16,
	"asleep": 17, "pain": 18, "exertion": 19, "shout": 20, "blink": _BLINK, "brows": 22, "shrug": 23, "lids": -1,
}

var name := ""
## The names of the weights, such as `jawOpen`.
var weight_names := PackedStringArray()
## The offset after the rig in its section, in bytes.
var end_bytes := 0
var _least := PackedInt64Array()
var _most := PackedInt64Array()
## For each input, the weights that it is the first input of, and the factors and second inputs (-1 without one) of
## these terms. Most inputs are 0 at a time, so their terms are skipped together.
var _terms: Array[PackedInt64Array] = []
var _inputs := PackedInt64Array()
var _sums := PackedInt64Array()


## Reads the rig at an offset of a section; null if it is damaged.
static func _read(section: Section, at: int) -> Variant:
	var name_length := section.u16(at)
	var weight_count := section.u16(at + 2)
	var term_count := section.u16(at + 4)
	var names_length := section.u16(at + 6)
	var first_weight_at := at + _RECORD_BYTES + name_length
	var terms_at := first_weight_at + weight_count * _WEIGHT_BYTES
	var names_at := terms_at + term_count * _TERM_BYTES
	if names_length < 0 or not section.has_bytes(names_at, names_length):
		return null
	var rig := LipzRig.new()
	rig.name = section.text(at + _RECORD_BYTES, name_length)
	rig.end_bytes = names_at + names_length
	rig._inputs.resize(_INPUTS)
	rig._sums.resize(weight_count)
	for _input in _INPUTS:
		rig._terms.append(PackedInt64Array())
	var name_start := 0
	var term := 0
	for index in weight_count:
		var weight_at := first_weight_at + index * _WEIGHT_BYTES
		var terms_end := mini(section.u16(weight_at), term_count)
		var name_end := section.u16(weight_at + 2)
		var is_inside := name_end >= name_start and name_end <= names_length
		rig.weight_names.append(section.text(names_at + name_start, name_end - name_start) if is_inside else "")
		rig._least.append(section.i16(weight_at + 4))
		rig._most.append(section.i16(weight_at + 6))
		while term < terms_end:
			rig._add_term(section, terms_at + term * _TERM_BYTES, index)
			term += 1
		name_start = name_end
	return rig


func _add_term(section: Section, at: int, weight: int) -> void:
	var first := section.u8(at + 2)
	var second := section.u8(at + 3)
	if first < _INPUTS and (second == _NO_INPUT or second < _INPUTS):
		_terms[first].append_array([weight, section.i16(at), -1 if second == _NO_INPUT else second])


## Writes the weights of a clip at a time into [param weights], in the order of [member weight_names]: articulation,
## emotions and face of a character. The character is the speaker, unless you pass a name; with `is_speaker`, the
## name is that of the speaker.
func weights_at(
	clip: LipzClip, seconds: float, weights: PackedFloat32Array, character := "", is_speaker := false,
	articulation: Articulation = null
) -> void:
	_weights_at_ns(clip, Clock.of_seconds(seconds), weights, character, is_speaker, articulation)


func _weights_at_ns(
	clip: LipzClip, time_ns: int, weights: PackedFloat32Array, character: String, is_speaker: bool,
	articulation: Articulation
) -> void:
	_compute(clip, time_ns, character, is_speaker, articulation)
	for index in _sums.size():
		weights[index] = _weight(index)


## Computes the sums of all terms at a time.
func _compute(
	clip: LipzClip, time_ns: int, character: String, is_speaker: bool, articulation: Articulation
) -> void:
	var used := articulation if articulation != null else clip.bank._usual_articulation()
	_inputs.fill(0)
	used.write(clip, time_ns, _inputs)
	_set_face(clip, time_ns, character, is_speaker, _inputs)
	for input in _INPUTS:
		_inputs[input] = clampi(_inputs[input], -_MOST_INPUT, _MOST_INPUT)
	_sums.fill(0)
	for input in _INPUTS:
		var value := _inputs[input]
		if value == 0:
			continue
		var terms := _terms[input]
		for at in range(0, terms.size(), 3):
			@warning_ignore("integer_division")
			var product := terms[at + 1] * value / 1000
			if terms[at + 2] >= 0:
				@warning_ignore("integer_division")
				product = product * _inputs[terms[at + 2]] / 1000
			_sums[terms[at]] += product


## Returns a weight from its sum.
func _weight(index: int) -> float:
	return clampi(_sums[index], _least[index], _most[index]) * 0.001


## Sets the inputs of emotions and face.
func _set_face(
	clip: LipzClip, time_ns: int, character: String, is_speaker: bool, inputs: PackedInt64Array
) -> void:
	inputs[_INPUTS - 1] = 1000
	var lids := 0
	var has_blink := false
	if clip.fps_numerator > 0 and not clip.curves().is_empty():
		var position := Clock.position(time_ns, clip.fps_numerator, clip.fps_denominator)
		var curves := LipzCurve._of_character(clip, character, is_speaker)
		for purpose in curves:
			if not _CURVE_INPUTS.has(purpose):
				continue
			var input := _CURVE_INPUTS[purpose]
			var value := LipzCurve._strongest(curves[purpose], position, 0)
			if input < 0:
				lids = value
			else:
				@warning_ignore("integer_division")
				inputs[input] = value / 10 if input < _BLINK else value
				has_blink = has_blink or input == _BLINK
	if not has_blink:
		var speaks := is_speaker or character == ""
		var id := clip._id if speaks else clip._id ^ Hashing.clip_id(character)
		var blinks: Blinks = Blinks.of(clip, clip.bank._usual_face_profile(), id)
		inputs[_BLINK] = blinks.closed(Clock.milliseconds(time_ns), clip, character, is_speaker)
	inputs[_BLINK] = maxi(inputs[_BLINK], lids)
