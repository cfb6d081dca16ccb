@tool
extends RefCounted
## The events of a bank: the strings of segments, and the typed events that were parsed from them.

const File := preload("file.gd")
const Section := preload("section.gd")

const NO_NAME := 0xFFFFFFFF
const FEELS := 1
const STARES := 3
const STOPS_STARING := 4
const POINTS := 5
const STOPS_POINTING := 6
const _RECORD_BYTES := 16
const _NAME_BYTES := 8
const _VERBS: Array[String] = [
	"", "feels", "sees", "stares", "stops staring", "points", "stops pointing", "does", "nods", "shakes", "breathes",
	"blinks", "looks away",
]
## The verbs with an object, and those whose object may be missing.
const _WITH_OBJECT: Array[int] = [1, 2, 3, 5, 7]
const _WITH_STRENGTH: Array[int] = [8, 9, 10]

var _references: Section
var _events: Section
var _typed: Section
var _names: Section
var _strings: Section
## The numbers of the names, filled by the first search for a name.
var _ids: Dictionary[String, int] = {}


func _init(file: File) -> void:
	_references = file.section("EVRF")
	_events = file.section("EVNT")
	_typed = file.section("EVTY")
	_names = file.section("EVNM")
	_strings = file.section("EVST")


## Whether the clip with this first segment has events.
func has_events(segments_first: int) -> bool:
	return segments_first * 4 < _references.length


func has_name(id: int) -> bool:
	return _names.has_bytes(id * _NAME_BYTES, _NAME_BYTES)


## Returns the name with a number; empty without one.
func name_of(id: int) -> String:
	if not has_name(id):
		return ""
	return _strings.text(_names.u32(id * _NAME_BYTES), _names.u32(id * _NAME_BYTES + 4))


## Returns the number of a name; [constant NO_NAME] if the bank does not have it.
func id_of(text: String) -> int:
	if _ids.is_empty():
		for id in _names.length >> 3:
			_ids[name_of(id)] = id
	return _ids.get(text, NO_NAME)


## Returns the offset of the record of the segment with a number; -1 without events.
func _record(number: int) -> int:
	var id := _references.u32(number * 4)
	return id * _RECORD_BYTES if id >= 0 and _events.has_bytes(id * _RECORD_BYTES, _RECORD_BYTES) else -1


## Returns the event string of the segment with a number.
func string_of(number: int) -> String:
	var at := _record(number)
	return _strings.text(_events.u32(at), _events.u32(at + 4)) if at >= 0 else ""


## Returns the typed events of the segment with a number, each as verb, number of the character and number of the
## object.
func typed_of(number: int) -> Array[PackedInt64Array]:
	var list: Array[PackedInt64Array] = []
	var at := _record(number)
	if at < 0:
		return list
	var first := _events.u32(at + 8)
	var count := _events.u32(at + 12)
	if not _typed.has_bytes(first * _RECORD_BYTES, count * _RECORD_BYTES):
		return list
	for index in range(first, first + count):
		var found := _typed_at(index * _RECORD_BYTES)
		if found.is_empty():
			break
		list.append(found)
	return list


## Returns a typed event; empty if it is damaged.
func _typed_at(at: int) -> PackedInt64Array:
	var character := _typed.u32(at)
	var object := _typed.u32(at + 4)
	var verb := _typed.u8(at + 8)
	if verb == 0 or verb >= _VERBS.size() or (character != NO_NAME and not has_name(character)):
		return PackedInt64Array()
	if object == NO_NAME:
		return PackedInt64Array() if verb in _WITH_OBJECT else PackedInt64Array([verb, character, object])
	if not has_name(object) or not (verb in _WITH_OBJECT or verb in _WITH_STRENGTH):
		return PackedInt64Array()
	return PackedInt64Array([verb, character, object])


## Adds the typed events of the segment with a number to a list. Events without a character get the speaker's.
func collect(number: int, speaker_id: int, list: Array[LipzEvent]) -> void:
	for found in typed_of(number):
		var event := LipzEvent.new()
		event.verb = _VERBS[found[0]]
		event.character = name_of(found[1] if found[1] != NO_NAME else speaker_id)
		event.object = name_of(found[2])
		list.append(event)
