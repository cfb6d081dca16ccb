@tool
extends RefCounted
## The lasting effects of events: emotions, stares and pointing.

const EventTable := preload("event_table.gd")

## The most events of a query, so that a forged bank cannot make it last.
const _MOST_STEPS := 1 << 20


## Returns the state of the character with a number, [constant EventTable.NO_NAME] for the speaker, after some
## segments.
static func after(clip: LipzClip, segments: Array[int], speaker: int, character: int) -> Dictionary[String, String]:
	var events := clip.bank._events
	var ids: Dictionary[String, int] = {}
	var left := _MOST_STEPS
	for segment in segments:
		for event in events.typed_of(clip._segments_first + segment):
			left -= 1
			var of := event[1] if event[1] != EventTable.NO_NAME else speaker
			if of == character or (character == EventTable.NO_NAME and of == speaker):
				_apply(ids, event[0], event[2])
		if left < 0:
			break
	var found: Dictionary[String, String] = {}
	for field in ids:
		found[field] = events.name_of(ids[field])
	return found


static func _apply(ids: Dictionary[String, int], verb: int, object: int) -> void:
	match verb:
		EventTable.FEELS:
			ids["emotion"] = object
		EventTable.STARES:
			ids["stares_at"] = object
		EventTable.STOPS_STARING:
			ids.erase("stares_at")
		EventTable.POINTS:
			ids["points_at"] = object
		EventTable.STOPS_POINTING:
			ids.erase("points_at")


## Returns the numbers of all characters in the clip's events, in the order of their names; a speaker without a name
## first.
static func characters(clip: LipzClip, speaker: int) -> Array[int]:
	var list: Array[int] = []
	var left := _MOST_STEPS
	for segment in clip.segment_count:
		for event in clip.bank._events.typed_of(clip._segments_first + segment):
			left -= 1
			var of := event[1] if event[1] != EventTable.NO_NAME else speaker
			if not of in list:
				list.append(of)
		if left < 0:
			break
	list.sort()
	if EventTable.NO_NAME in list:
		list.erase(EventTable.NO_NAME)
		list.push_front(EventTable.NO_NAME)
	return list
