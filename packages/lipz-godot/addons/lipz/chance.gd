@tool
extends RefCounted
## Chance that depends only on a seed: the formulas of docs/guides/faces.md, generated motion.

const Hashing := preload("hashing.gd")

enum Stream {
	BLINK_PHASE = 1, BLINK_TIME, DOUBLE_BLINK, POSE_TIME, PITCH, YAW, ROLL, FIXATION_TIME, GLANCE, TARGET, EYE_PITCH,
	EYE_YAW,
}

## The whole of a part.
const WHOLE := 65536


## Returns a number from 0 to 65,535.
static func draw(id: int, stream: Stream, interval: int, index: int) -> int:
	var found := Hashing.mix(id ^ (interval << 8 | stream), Hashing.STEP)
	found = Hashing.mix(found ^ index, Hashing.FINISH)
	return Hashing.mix(found, Hashing.STEP) >> 48 & 0xFFFF


## Returns a number from 0 up to but not including `amount`.
static func part(amount: int, drawn: int) -> int:
	return amount * drawn >> 16


## Returns a number from `-amount` up to `amount`.
static func either_side(amount: int, drawn: int) -> int:
	return part(2 * amount, drawn) - amount


## Returns `value * done / WHOLE`, rounded towards zero.
static func scaled(value: int, done: int) -> int:
	return value * done >> 16 if value >= 0 else -(-value * done >> 16)


## Returns the numbers of the states before and after the last step, and how much of the step is done.
static func step(id: int, ms: int, stream: Stream, period_ms: int, duration_ms: int) -> Vector3i:
	var number := int(ms / float(maxi(period_ms, 1)))
	var started := _start(id, stream, period_ms, number)
	if ms < started:
		number -= 1
		if number < 0:
			return Vector3i(0, 0, WHOLE)
		started = _start(id, stream, period_ms, number)
	var passed := ms - started
	var done := int(passed * WHOLE / float(duration_ms)) if passed < duration_ms else WHOLE
	return Vector3i(number, number + 1, done)


static func _start(id: int, stream: Stream, period_ms: int, number: int) -> int:
	return number * period_ms + part(period_ms >> 1, draw(id, stream, 0, number))
