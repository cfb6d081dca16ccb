@tool
extends RefCounted
## Emotions: the curves of twelve names (docs/guides/faces.md). Values are in thousandths.

const Clock := preload("clock.gd")

const NAMES: Array[String] = [
	"sadness", "anger", "joy", "fear", "disgust", "surprise", "shock", "perplexed", "asleep", "pain", "exertion",
	"shout",
]
const _INDICES: Dictionary[String, int] = {
	"sadness": 0, "anger": 1, "joy": 2, "fear": 3, "disgust": 4, "surprise": 5, "shock": 6, "perplexed": 7, "asleep": 8,
	"pain": 9, "exertion": 10, "shout": 11,
}


## Returns the twelve values of a character at a time, in the order of [constant NAMES].
static func thousandths(clip: LipzClip, time_ns: int, character := "", is_speaker := false) -> PackedInt64Array:
	var values := PackedInt64Array()
	values.resize(NAMES.size())
	if clip.fps_numerator == 0 or clip.curves().is_empty():
		return values
	var position := Clock.position(time_ns, clip.fps_numerator, clip.fps_denominator)
	var curves := LipzCurve._of_character(clip, character, is_speaker)
	for purpose in curves:
		if _INDICES.has(purpose):
			values[_INDICES[purpose]] = LipzCurve._strongest(curves[purpose], position, 0)
	return values


## Returns the index of the strongest emotion; -1 if all are at most 0.
static func strongest(values: PackedInt64Array) -> int:
	var found := -1
	var most := 0
	for index in values.size():
		if values[index] > most:
			found = index
			most = values[index]
	return found


## Returns the values that are not 0, by name.
static func named(values: PackedInt64Array) -> Dictionary[String, float]:
	var found: Dictionary[String, float] = {}
	for index in values.size():
		if values[index] != 0:
			found[NAMES[index]] = values[index] / 1000.0
	return found
