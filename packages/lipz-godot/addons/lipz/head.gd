@tool
extends RefCounted
## The generated motion of the head while the mouth moves (docs/guides/faces.md).

const Chance := preload("chance.gd")
const Clock := preload("clock.gd")
const FaceProfile := preload("face_profile.gd")

const _NEAR_US := 250000
const _LOOKED_AT_MS := 1000

var _clip: LipzClip
var _codes: String
var _profile: FaceProfile
var _id: int
var _ms: int


func _init(clip: LipzClip, profile: FaceProfile, id: int, ms: int) -> void:
	_clip = clip
	_codes = clip.frames()
	_profile = profile
	_id = id
	_ms = ms


func _frame_at(us: int) -> int:
	return Clock.frame(maxi(us, 0) * 1000, _clip.fps_numerator, _clip.fps_denominator)


func _moves(frame: int) -> bool:
	return _codes[frame] != LipzClip.REST


## Returns how much the head moves, in thousandths: less, the farther the mouth is from a frame that is not rest.
func _speaking() -> int:
	var now_us := _ms * 1000
	var now := _frame_at(now_us)
	var nearest := _NEAR_US
	for frame in range(mini(now, _codes.length() - 1), _frame_at(now_us - _NEAR_US) - 1, -1):
		if _moves(frame):
			nearest = mini(nearest, maxi(now_us - _clip.start_of_frame_us(frame + 1), 0))
			break
	for frame in range(now + 1, mini(_frame_at(now_us + _NEAR_US), _codes.length() - 1) + 1):
		if _moves(frame):
			nearest = mini(nearest, _clip.start_of_frame_us(frame) - now_us)
			break
	return int((_NEAR_US - nearest) / 250.0)


func _start_ms(frame: int) -> int:
	return int(_clip.start_of_frame_us(frame) / 1000.0)


## Returns the time of the first change in a slot: a segment starts, or the mouth starts or stops to move; -1 if
## there is none.
func _change_ms(slot_ms: int) -> int:
	var end_us := (slot_ms + mini(_profile.pose_ms, _LOOKED_AT_MS)) * 1000
	var before := _frame_at(slot_ms * 1000 - 1)
	var last := mini(_frame_at(end_us - 1), _codes.length() - 1)
	if last < before:
		return -1
	var segment_start := _clip.segment_frames(_clip.segment_of_frame(last)).x
	if segment_start > before:
		return _start_ms(segment_start)
	for frame in range(before, last):
		if _moves(frame) != _moves(frame + 1):
			return _start_ms(frame + 1)
	return -1


static func _eased(passed_ms: int, length_ms: int) -> int:
	var x := Chance.WHOLE
	if length_ms > 0:
		x = mini(int(passed_ms * Chance.WHOLE / float(length_ms)), Chance.WHOLE)
	return (x * x >> 16) * (3 * Chance.WHOLE - 2 * x) >> 16


func _turned(slot: int) -> int:
	if slot < 0:
		return 0
	var start := _change_ms(slot * _profile.pose_ms)
	if start < 0:
		var drawn := Chance.draw(_id, Chance.Stream.POSE_TIME, 0, slot)
		start = slot * _profile.pose_ms + Chance.part(_profile.pose_ms >> 1, drawn)
	return _eased(maxi(_ms - start, 0), _profile.pose_ms >> 1)


## Returns three poses, each a number and a share in thousandths, and how far the head has turned to the second and
## to the third.
func _poses_at_keys(poses: LipzCurve) -> PackedInt64Array:
	var index := poses._index_at(_frame_at(_ms * 1000))
	var before := maxi(index - 1, 0)
	var start := _start_ms(poses._frames[index])
	var length := _profile.pose_ms >> 1
	if index + 1 < poses.key_count:
		length = mini(length, maxi(_start_ms(poses._frames[index + 1]) - start, 0))
	var share_before := clampi(poses._values[before], 0, 1000)
	return PackedInt64Array([
		poses._frames[before], share_before, poses._frames[before], share_before, poses._frames[index],
		clampi(poses._values[index], 0, 1000), 0, _eased(maxi(_ms - start, 0), length),
	])


func _poses_in_slots() -> PackedInt64Array:
	var slot := int(_ms / float(maxi(_profile.pose_ms, 1)))
	return PackedInt64Array([
		maxi(slot - 1, 0), 1000, slot, 1000, slot + 1, 1000, _turned(slot - 1), _turned(slot),
	])


func _angle(stream: Chance.Stream, most: int, poses: PackedInt64Array) -> int:
	var a := Chance.either_side(int(most * poses[1] / 1000.0), Chance.draw(_id, stream, 0, poses[0]))
	var b := Chance.either_side(int(most * poses[3] / 1000.0), Chance.draw(_id, stream, 0, poses[2]))
	var c := Chance.either_side(int(most * poses[5] / 1000.0), Chance.draw(_id, stream, 0, poses[4]))
	return a + Chance.scaled(b - a, poses[6]) + Chance.scaled(c - b, poses[7])


## Returns pitch, yaw and roll in thousandths of a degree. `poses` is the curve with the times of turns, or null.
func motion(poses: LipzCurve) -> Vector3i:
	var much := _speaking()
	if much == 0:
		return Vector3i.ZERO
	var found := _poses_in_slots() if poses == null or poses.key_count == 0 else _poses_at_keys(poses)
	var most := _profile.head_motion
	var pitch := _angle(Chance.Stream.PITCH, int(most * 2 / 3.0), found)
	var yaw := _angle(Chance.Stream.YAW, most, found)
	var roll := _angle(Chance.Stream.ROLL, most >> 1, found)
	return Vector3i(int(pitch * much / 1000.0), int(yaw * much / 1000.0), int(roll * much / 1000.0))
