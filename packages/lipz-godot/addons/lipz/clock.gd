@tool
extends RefCounted
## Times and frames. A time is a number of whole nanoseconds. Times before the start are negative. A frame rate is a
## ratio of two numbers of up to 32 bits.

## The time of everything that is later.
const LATEST_NS := 0x7FFFFFFFFFFFFFFF
## An invalid time, which is before the start.
const BEFORE_NS := -0x4000000000000000
## The frame after every clip.
const LAST_FRAME := 0xFFFFFFFF
const _NS := 1000000000
const _LATEST_SECONDS := 0x7FFFFFFF


## Returns the time of a number of seconds, rounded up.
static func of_seconds(seconds: float) -> int:
	if seconds >= _LATEST_SECONDS:
		return LATEST_NS
	return int(ceil(seconds * 1e9)) if seconds > -_LATEST_SECONDS else BEFORE_NS


static func of_us(us: int) -> int:
	if us >= _LATEST_SECONDS * 1000000:
		return LATEST_NS
	return us * 1000 if us > -_LATEST_SECONDS * 1000000 else BEFORE_NS


## Returns the time of a position in samples, rounded up.
static func of_samples(samples: int, rate_hz: int) -> int:
	if samples < 0 or rate_hz <= 0:
		return BEFORE_NS
	@warning_ignore("integer_division")
	var seconds := samples / rate_hz
	if seconds >= _LATEST_SECONDS:
		return LATEST_NS
	@warning_ignore("integer_division")
	return seconds * _NS + (samples % rate_hz * _NS + rate_hz - 1) / rate_hz


## Returns the time that is some microseconds later.
static func later(time_ns: int, us: int) -> int:
	return LATEST_NS if time_ns > LATEST_NS - us * 1000 else time_ns + us * 1000


## Returns the frame at a time; -1 before the start, [constant LAST_FRAME] after every clip.
static func frame(time_ns: int, numerator: int, denominator: int) -> int:
	if time_ns < 0:
		return -1
	@warning_ignore("integer_division")
	var seconds := time_ns / _NS
	if seconds >= _LATEST_SECONDS:
		return LAST_FRAME
	@warning_ignore("integer_division")
	var found := (seconds * numerator + time_ns % _NS * numerator / _NS) / denominator
	return mini(found, LAST_FRAME)


## Returns the frame at a time, in units of 1/65,536 of a frame; 0 before the start.
static func position(time_ns: int, numerator: int, denominator: int) -> int:
	var found := frame(time_ns, numerator, denominator)
	if found < 0:
		return 0
	if found >= LAST_FRAME:
		return (LAST_FRAME << 16) | 0xFFFF
	@warning_ignore("integer_division")
	var seconds := time_ns / _NS
	var whole := denominator * _NS
	var rest := (seconds * numerator % denominator * _NS + time_ns % _NS * numerator) % whole
	if whole < 0x800000000000:
		@warning_ignore("integer_division")
		return (found << 16) | (rest * 65536 / whole)
	for _bit in 16:
		found *= 2
		rest *= 2
		if rest >= whole:
			found += 1
			rest -= whole
	return found


## Returns the first microsecond of a frame.
static func start_of_frame_us(of_frame: int, numerator: int, denominator: int) -> int:
	var scaled := of_frame * denominator
	@warning_ignore("integer_division")
	return scaled / numerator * 1000000 + (scaled % numerator * 1000000 + numerator - 1) / numerator


## Returns the whole milliseconds of a time: 0 before the start, at most 2^32 - 1.
static func milliseconds(time_ns: int) -> int:
	@warning_ignore("integer_division")
	return clampi(time_ns / 1000000, 0, LAST_FRAME)
