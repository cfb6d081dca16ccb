@icon("icon.svg")
class_name LipzPlayer
extends Node
## Plays clips of a bank: follows an audio player, and emits events and subtitles. Add a [LipzFace3D] or a
## [LipzMouth2D] to show the mouth.

const Clock := preload("clock.gd")

## Emitted once for each event, in order, however long the rendered frame took.
signal event_fired(event: LipzEvent)
## Emitted once for each segment with an event string, which may have a different syntax than [LipzEvent].
signal segment_began(segment: int, event_string: String)
## Emitted when the subtitle changes; the text is empty when it ends.
signal subtitle_changed(text: String)
## Emitted when the viseme changes, one character; `-` is rest.
signal viseme_changed(viseme: String)
## Emitted when a clip has ended, and also when it was stopped. A receiver may play the next clip, unless
## [method play] has replaced the clip that ended.
signal finished

enum Hold {
	## Show consonants as long as the clip says.
	NONE,
	## Show consonants until viewers can read them.
	READABLE,
}

const _NONE := -2
## Audio is mixed more often, but the time since the last mix grows while the game loads.
const _LONGEST_MIX_SECONDS := 0.1

## The bank. `load("res://voices.lipzbank")` returns it.
@export var bank: LipzBank
## The [AudioStreamPlayer], [AudioStreamPlayer2D] or [AudioStreamPlayer3D] that plays the recordings. Without one,
## clips follow the time of the game.
@export var audio: Node
## The language of subtitles, such as `de-de`, `de-DE` or `de`; empty for that of [TranslationServer]. If the bank
## does not have it (see [method LipzBank.nearest_locale]), the player uses the default language of the bank.
@export var locale := ""
## By how many frames visemes are ahead of the audio.
@export_range(0, 2) var lead_frames := 0
## How long consonants are shown.
@export var hold := Hold.READABLE
## The frame rate of clips that do not specify one.
@export_range(1, 1000) var default_fps := 24

## The clip that plays; null when nothing plays.
var clip: LipzClip
## The name of the character who speaks the clip.
var speaker := ""
var _cursor: LipzCursor
## Whether [method play] stops the clip before it begins the next one.
var _is_replacing := false
var _locale: LipzLocale
## The missing language that was reported last.
var _reported_locale := ""
var _time_ns := 0
var _subtitle := ""
var _viseme := LipzClip.REST
## The segment that is shown, and the places of the cursor and of its mouth in the last rendered frame.
var _segment := _NONE
var _place := _NONE
var _mouth := _NONE
## The segments that have begun and the events that are due, but were not emitted yet.
var _begun_segments: Array[int] = []
var _due_events: Array[LipzEvent] = []


## Plays a clip, with its recording if there is an audio player. The speaker is the character to whom events without a
## name belong. Returns false if the bank does not have the clip, or if a receiver of [signal finished] plays a clip
## while another one begins.
func play(key: String, of_speaker := "", recording: AudioStream = null) -> bool:
	if _is_replacing:
		return false
	_is_replacing = true
	stop()
	_is_replacing = false
	var found := bank.clip(key) if bank != null else null
	if found == null:
		push_error("lipz: the bank does not have the clip ", key)
		return false
	clip = found.or_fps(default_fps)
	speaker = of_speaker
	_cursor = clip.cursor(of_speaker)
	_cursor.set_lead_frames(lead_frames)
	if hold == Hold.READABLE:
		_cursor.set_hold_readable()
	_locale = _find_locale()
	_time_ns = 0
	_segment = _NONE
	_place = _NONE
	_mouth = _NONE
	if audio != null:
		if recording != null:
			audio.set("stream", recording)
		audio.call("play")
	_advance()
	return true


## Stops the clip and its recording. The face rests. Remaining events are not emitted; for a skipped line, call
## [method skip] instead.
func stop() -> void:
	if clip == null:
		return
	if audio != null:
		audio.call("stop")
	_end()


## Ends the clip, and emits all remaining events, so that lasting states take effect. If a receiver stops the clip or
## plays the next one, the events after that are not emitted.
func skip() -> void:
	if clip == null:
		return
	var playing := _cursor
	_emit(playing.finish())
	if _cursor == playing:
		stop()


## Jumps to a time of the clip. Events before it are not emitted.
func seek(seconds: float) -> void:
	if clip == null:
		return
	_time_ns = Clock.of_seconds(seconds)
	_cursor.seek_ns(_time_ns)
	if audio != null:
		audio.call("seek", seconds)


## Whether a clip plays.
func is_playing() -> bool:
	return clip != null


## Returns the time of the clip in seconds.
func time() -> float:
	return _time_ns / 1e9


## Returns the time of the clip in nanoseconds.
func time_ns() -> int:
	return _time_ns


## Returns the viseme that is shown, one character.
func viseme() -> String:
	return _viseme


## Returns what a character feels, stares at and points at (see [method LipzCursor.state]).
func state(character := "") -> Dictionary[String, String]:
	return _cursor.state(character) if _cursor != null else {}


func _find_locale() -> LipzLocale:
	var tag := locale if locale != "" else TranslationServer.get_locale()
	var found := bank.nearest_locale(tag)
	if found == null and locale not in ["", _reported_locale]:
		_reported_locale = locale
		push_warning("lipz: the bank does not have the language ", locale)
	return found if found != null else bank.default_locale()


func _process(delta: float) -> void:
	if clip == null:
		return
	if audio == null or audio.get("stream") == null:
		_time_ns += Clock.of_seconds(delta)
	elif audio.get("playing"):
		_time_ns = Clock.of_seconds(_audio_time())
	elif not audio.get("stream_paused"):
		_time_ns = Clock.of_seconds(clip.duration()) # the recording has ended
	_advance()


## Returns the position that the listener hears. The position of the player only changes when audio is mixed.
func _audio_time() -> float:
	var position: float = audio.call("get_playback_position")
	var since_mix := minf(AudioServer.get_time_since_last_mix(), _LONGEST_MIX_SECONDS)
	return position + since_mix - AudioServer.get_output_latency()


func _advance() -> void:
	# The receiver of any signal may end this clip, or play the next one.
	var playing := _cursor
	_emit(playing.advance_to_ns(_time_ns))
	if _cursor == playing and playing._mouth != _mouth:
		_mouth = playing._mouth
		_set_viseme(playing.viseme())
	if _cursor == playing and playing._place != _place:
		_place = playing._place
		_show_segment(playing.segment())
	if _cursor == playing and playing.is_over() and _time_ns >= Clock.of_seconds(clip.duration()):
		_end()


## Emits segments and events in order, each once, also if a receiver skips the clip. [method _end] clears what is left.
func _emit(events: Array[LipzEvent]) -> void:
	_begun_segments.append_array(_cursor.due_segments)
	_due_events.append_array(events)
	while not _begun_segments.is_empty():
		var segment: int = _begun_segments.pop_front()
		segment_began.emit(segment, clip.event(segment))
	while not _due_events.is_empty():
		var event: LipzEvent = _due_events.pop_front()
		event_fired.emit(event)


func _show_segment(segment: int) -> void:
	if segment != _segment:
		_segment = segment
		_set_subtitle(_cursor.text(_locale))


func _set_viseme(viseme_to_show: String) -> void:
	if viseme_to_show != _viseme:
		_viseme = viseme_to_show
		viseme_changed.emit(_viseme)


func _set_subtitle(text: String) -> void:
	if text != _subtitle:
		_subtitle = text
		subtitle_changed.emit(text)


func _end() -> void:
	clip = null
	_cursor = null
	_begun_segments.clear()
	_due_events.clear()
	_set_viseme(LipzClip.REST)
	if clip == null: # otherwise, a receiver has played the next clip
		_set_subtitle("")
	finished.emit()


func _exit_tree() -> void:
	stop()
