@tool
class_name LipzFace
extends RefCounted
## The face of a character at a time: blinks, head and eyes, from generated motion and curves. Angles are in degrees.

const Blinks := preload("blinks.gd")
const Chance := preload("chance.gd")
const Clock := preload("clock.gd")
const FaceProfile := preload("face_profile.gd")
const Hashing := preload("hashing.gd")
const Head := preload("head.gd")

const _SACCADE_MS := 50
const _OF_A_FACE: Array[Vector2i] = [Vector2i(0, 1900), Vector2i(0, -1900), Vector2i(-4000, 0)]
const _NEUTRAL := 5000
## The neutral value of each curve of a face.
const _NEUTRALS: Dictionary[String, int] = {
	"blink": 0, "headPitch": 0, "headYaw": 0, "headRoll": 0, "eyePitch": 0, "eyeYaw": 0, "lids": 0, "nod": _NEUTRAL,
	"shake": _NEUTRAL, "lookPitch": 0, "lookYaw": 0, "brows": 0, "shrug": 0, "breath": 0,
}
const _HEAD_MOST := 60000
const _LOOK_MOST := 1000000.0

## How far the lids are closed, from 0 to 1.
var blink := 0.0
## Positive is up.
var head_pitch := 0.0
## Positive is left, from the point of view of the face.
var head_yaw := 0.0
var head_roll := 0.0
var eye_pitch := 0.0
var eye_yaw := 0.0
## How far the brows are raised, from 0 to 1.
var brows := 0.0
## How far the face shrugs, from 0 to 1.
var shrug := 0.0
## The depth of breath, from 0 to 10.
var breath := 0.0


## Returns the face of a character of a clip at a time. The character is the speaker, unless you pass a name; with
## `is_speaker`, the name is that of the speaker. The eyes look at a person in a direction in degrees (pitch, yaw), or
## with `is_person` false at a thing.
static func at(
	clip: LipzClip, seconds: float, character := "", is_speaker := false, look := Vector2.ZERO, is_person := true,
	profile: FaceProfile = null
) -> LipzFace:
	return _at_ns(clip, Clock.of_seconds(seconds), character, is_speaker, look, is_person, profile)


## Returns the face of a silent character at a time. Characters differ by their seeds.
static func idle(
	seconds: float, of_seed: int, look := Vector2.ZERO, is_person := true, profile: FaceProfile = null
) -> LipzFace:
	return _idle_ns(Clock.of_seconds(seconds), of_seed, look, is_person, profile)


static func _idle_ns(
	time_ns: int, of_seed: int, look: Vector2, is_person: bool, profile: FaceProfile
) -> LipzFace:
	var used := profile if profile != null else FaceProfile.new()
	var ms := Clock.milliseconds(time_ns)
	var blinks := Blinks.new(used, of_seed)
	var face := LipzFace.new()
	face.blink = blinks.closed(ms, null, "", true) / 1000.0
	face._set_angles(used, Vector3i.ZERO, _eyes(used, of_seed, ms, look, is_person), {})
	return face


static func _at_ns(
	clip: LipzClip, time_ns: int, character: String, is_speaker: bool, look: Vector2, is_person: bool,
	profile: FaceProfile
) -> LipzFace:
	var used := profile if profile != null else clip.bank._usual_face_profile()
	var speaks := is_speaker or character == ""
	var id := clip._id if speaks else clip._id ^ Hashing.clip_id(character)
	var ms := Clock.milliseconds(time_ns)
	var values := _curve_values(clip, time_ns, character, is_speaker)
	var head := Vector3i.ZERO
	if speaks and clip.fps_numerator > 0:
		head = Head.new(clip, used, id, ms).motion(_poses(clip, character, is_speaker))
	var face := LipzFace.new()
	face.blink = _blink(clip, used, id, ms, character, is_speaker, values) / 1000.0
	face._set_angles(used, head, _eyes(used, id, ms, look, is_person), values)
	face.brows = values.get("brows", 0) / 1000.0
	face.shrug = values.get("shrug", 0) / 1000.0
	face.breath = values.get("breath", 0) / 1000.0
	return face


static func _blink(
	clip: LipzClip, profile: FaceProfile, id: int, ms: int, character: String, is_speaker: bool,
	values: Dictionary[String, int]
) -> int:
	if values.has("blink"):
		return maxi(values["blink"], values.get("lids", 0))
	var blinks: Blinks = Blinks.of(clip, profile, id)
	return maxi(blinks.closed(ms, clip, character, is_speaker), values.get("lids", 0))


## Returns the curve with the times of turns; null without one.
static func _poses(clip: LipzClip, character: String, is_speaker: bool) -> LipzCurve:
	var found: LipzCurve = null
	for curve: LipzCurve in LipzCurve._of_character(clip, character, is_speaker).get("pose", []):
		if found == null or found.name.length() <= curve.name.length():
			found = curve
	return found


## Returns the values of the curves of a face that the clip has, in thousandths.
static func _curve_values(
	clip: LipzClip, time_ns: int, character: String, is_speaker: bool
) -> Dictionary[String, int]:
	var values: Dictionary[String, int] = {}
	if clip.fps_numerator == 0 or clip.curves().is_empty():
		return values
	var position := Clock.position(time_ns, clip.fps_numerator, clip.fps_denominator)
	var curves := LipzCurve._of_character(clip, character, is_speaker)
	for purpose in curves:
		if _NEUTRALS.has(purpose):
			values[purpose] = LipzCurve._strongest(curves[purpose], position, _NEUTRALS[purpose])
	return values


static func _fixation(profile: FaceProfile, id: int, number: int) -> Vector2i:
	if Chance.part(100, Chance.draw(id, Chance.Stream.GLANCE, 0, number)) < profile.glance_percent:
		var down := 10000 + Chance.part(8000, Chance.draw(id, Chance.Stream.EYE_PITCH, 0, number))
		return Vector2i(-down, Chance.either_side(12000, Chance.draw(id, Chance.Stream.EYE_YAW, 0, number)))
	return _OF_A_FACE[Chance.part(_OF_A_FACE.size(), Chance.draw(id, Chance.Stream.TARGET, 0, number))]


## Returns pitch and yaw of the eyes in thousandths of a degree.
static func _eyes(profile: FaceProfile, id: int, ms: int, look: Vector2, is_person: bool) -> Vector2i:
	var target := Vector2i((look * 1000.0).round().clampf(-_LOOK_MOST, _LOOK_MOST))
	if not is_person:
		return target
	var step := Chance.step(id, ms, Chance.Stream.FIXATION_TIME, profile.fixation_ms, _SACCADE_MS)
	var before := _fixation(profile, id, step.x)
	var now := _fixation(profile, id, step.y)
	return target + before + Vector2i(Chance.scaled(now.x - before.x, step.z), Chance.scaled(now.y - before.y, step.z))


## Sets the angles of head and eyes. The head follows the eyes beyond an angle.
func _set_angles(profile: FaceProfile, head: Vector3i, eyes: Vector2i, values: Dictionary[String, int]) -> void:
	var gaze_pitch: int = values.get("eyePitch", eyes.x) + values.get("lookPitch", 0)
	var gaze_yaw: int = values.get("eyeYaw", eyes.y) + values.get("lookYaw", 0)
	var turned_pitch := clampi(gaze_pitch, -profile.head_follows, profile.head_follows)
	var turned_yaw := clampi(gaze_yaw, -profile.head_follows, profile.head_follows)
	var follow_pitch := clampi(gaze_pitch - turned_pitch, -_HEAD_MOST, _HEAD_MOST)
	var follow_yaw := clampi(gaze_yaw - turned_yaw, -_HEAD_MOST, _HEAD_MOST)
	var nod: int = (values.get("nod", _NEUTRAL) - _NEUTRAL) * 2
	var shake: int = (values.get("shake", _NEUTRAL) - _NEUTRAL) * 2
	eye_pitch = turned_pitch / 1000.0
	eye_yaw = turned_yaw / 1000.0
	head_pitch = (values.get("headPitch", head.x) + nod + follow_pitch) / 1000.0
	head_yaw = (values.get("headYaw", head.y) + shake + follow_yaw) / 1000.0
	head_roll = values.get("headRoll", head.z) / 1000.0
