@tool
class_name LipzCursor
extends RefCounted
## The position in a clip while it plays. It follows the audio, and returns each event once. Get it with
## [method LipzClip.cursor].

const Clock := preload("clock.gd")
const EventTable := preload("event_table.gd")
const Hold := preload("hold.gd")
const States := preload("states.gd")

const _WAITING := -1
const _OVER := 0xFFFFFFFF
const _MOST_HOLD := 255

var clip: LipzClip
## By how many microseconds visemes are ahead of the audio. Segments and events stay with the audio.
var lead_us := 0
## The least number of frames of a consonant.
var hold := 0
## The segments that the last call has begun.
var due_segments: Array[int] = []
var _speaker := EventTable.NO_NAME
var _place := _WAITING
var _mouth := _WAITING
var _next_segment := 0
var _has_fired := false
var _has_looped := false
var _viseme_type := ""


static func _of(of_clip: LipzClip, speaker: String) -> LipzCursor:
	var cursor := LipzCursor.new()
	cursor.clip = of_clip
	cursor._viseme_type = of_clip.viseme_type
	cursor.set_speaker(speaker)
	return cursor


## Sets the character to whom events without a character belong, by name; empty for none.
func set_speaker(speaker: String) -> void:
	_speaker = clip.bank._events.id_of(speaker) if speaker != "" else EventTable.NO_NAME


## Shows the visemes some frames ahead of the audio.
func set_lead_frames(frames: int) -> void:
	lead_us = clip.start_of_frame_us(frames)


## Holds consonants until viewers can read them: two frames at 24 frames per second.
func set_hold_readable() -> void:
	var twelfths := 12 * clip.fps_denominator
	@warning_ignore("integer_division")
	hold = mini((clip.fps_numerator + twelfths / 2) / twelfths, _MOST_HOLD)


## Holds consonants for one rendered frame of some microseconds.
func set_hold_for_display(rendered_frame_us: int) -> void:
	var second := clip.fps_denominator * 1000000
	@warning_ignore("integer_division")
	hold = mini((rendered_frame_us * clip.fps_numerator + second - 1) / second, _MOST_HOLD)


## Continues at the same time in a new version of the clip, which may be from a different bank. Set the speaker again.
func resume(in_clip: LipzClip) -> void:
	clip = in_clip.or_fps(clip.fps_numerator, clip.fps_denominator).or_viseme_type(_viseme_type)
	_speaker = EventTable.NO_NAME


## The frame at the position; -1 before the start and from the end on.
func frame() -> int:
	return _place if _place != _OVER else -1


## Whether the clip has ended.
func is_over() -> bool:
	return _place == _OVER


func _frame_at(time_ns: int) -> int:
	var found := Clock.frame(time_ns, clip.fps_numerator, clip.fps_denominator)
	return found if found < clip.frame_count else _OVER


func _show(time_ns: int) -> void:
	_place = _frame_at(time_ns)
	_mouth = _place if lead_us == 0 else _frame_at(Clock.later(time_ns, lead_us))


func _begun_by(of_frame: int) -> int:
	return clip.segment_of_frame(of_frame) + 1


func _begun() -> int:
	if _place == _WAITING:
		return 0
	return clip.segment_count if _place == _OVER else _begun_by(_place)


## Returns the events of the segments from `first` up to `last`, and then up to `around_to`.
func _due(first: int, last: int, around_to: int) -> Array[LipzEvent]:
	var list: Array[LipzEvent] = []
	due_segments.clear()
	if first >= last and around_to == 0:
		return list
	due_segments.append_array(range(first, last))
	due_segments.append_array(range(around_to))
	for index in due_segments:
		clip.bank._events.collect(clip._segments_first + index, _speaker, list)
	return list


## Follows the audio to a time in seconds. Returns the events that are due, in order, each once, however long the
## rendered frame took. [member due_segments] has the segments that have begun.
func advance_to(seconds: float) -> Array[LipzEvent]:
	return advance_to_ns(Clock.of_seconds(seconds))


func advance_to_ns(time_ns: int) -> Array[LipzEvent]:
	var before := _place
	var first := _next_segment
	_show(time_ns)
	if _place != before or not _has_fired:
		_next_segment = maxi(first, _begun())
		_has_fired = true
	return _due(first, _next_segment, 0)


## Follows audio that has looped from its end to its start. Returns what is due up to the end, then from the start.
func loop_to(seconds: float) -> Array[LipzEvent]:
	return loop_to_ns(Clock.of_seconds(seconds))


func loop_to_ns(time_ns: int) -> Array[LipzEvent]:
	_show(time_ns)
	var first := _next_segment
	_next_segment = _begun()
	_has_fired = true
	_has_looped = true
	return _due(first, clip.segment_count, _next_segment)


## Follows audio that has jumped. The next [method advance_to] returns the events of the segments that start in this
## frame.
func seek(seconds: float) -> void:
	seek_ns(Clock.of_seconds(seconds))


func seek_ns(time_ns: int) -> void:
	_show(time_ns)
	_next_segment = _begun_by(mini(_place, clip.frame_count) - 1)
	_has_fired = false
	_has_looped = false


## Ends the clip. Returns all remaining events, so that lasting states take effect.
func finish() -> Array[LipzEvent]:
	_place = _OVER
	_mouth = _OVER
	var first := _next_segment
	_next_segment = clip.segment_count
	_has_fired = true
	return _due(first, _next_segment, 0)


## Returns the viseme to show, one character.
func viseme() -> String:
	if hold < 2 or _mouth < 0 or _mouth >= clip.frame_count:
		return clip.viseme(_mouth)
	return clip.viseme(Hold.shown(clip.frames(), clip.viseme_type, hold, _mouth))


## Returns how far the mouth is open, from 0 to 0.99; -1 without frames or viseme type.
func openness() -> float:
	return clip.openness(viseme())


## Returns the segment at the position; -1 before the start and from the end on.
func segment() -> int:
	return clip.segment_of_frame(frame())


## Returns the subtitle at the position; empty without a text.
func text(locale: LipzLocale) -> String:
	return clip.text(segment(), locale)


## Returns the state of a character, by name; empty for the speaker: `emotion`, `stares_at` and `points_at`, without
## those that no event has set.
func state(character := "") -> Dictionary[String, String]:
	var id := EventTable.NO_NAME if character == "" else clip.bank._events.id_of(character)
	if character != "" and id == EventTable.NO_NAME:
		return {}
	return States.after(clip, _past(), _speaker, id)


## Returns the state of each character in the clip's events, by name, in the order of the names. The name is empty
## for a speaker without a name.
func characters() -> Dictionary[String, Dictionary]:
	var found: Dictionary[String, Dictionary] = {}
	for id in States.characters(clip, _speaker):
		found[clip.bank._events.name_of(id)] = States.after(clip, _past(), _speaker, id)
	return found


## Returns the segments that the clip has played.
func _past() -> Array[int]:
	var list: Array[int] = []
	if _has_looped:
		list.append_array(range(clip.segment_count))
	list.append_array(range(_next_segment))
	return list
