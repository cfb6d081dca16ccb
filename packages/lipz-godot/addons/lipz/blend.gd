@tool
extends RefCounted
## The blend of sounds that overlap: the formulas of docs/reference/bank-format.md, computing articulation. Values
## are in thousandths, times in microseconds from the query.
##
## A face does this in each rendered frame, so calls of functions are few here.

const Targets := preload("targets.gd")

const _LONGEST_RISE_US := 150000
const _LONGEST_RELEASE_US := 40000
const _JAW_US := 140000
const _LIPS_US := 120000
const _ROUNDING_US := 150000
const _TONGUE_US := 60000
const _TONGUE_STRENGTH := 10
const _FULL := 10000
const _JAW_CAP := 80
const _TEETH_CAP := 150

var _are_certain := true
var _jaw := 0
var _opening := 0
var _rounding := 0
var _spreading := 0
var _tip := 0
var _out := 0
var _back := 0
var _jaw_weight := 0
var _lips_weight := 0
var _rounding_weight := 0
var _tongue_weight := 0
var _closure := 0
var _teeth := 0
var _narrow := 0


## Starts a blend.
func start(are_certain: bool) -> void:
	_are_certain = are_certain
	_jaw = 0
	_opening = 0
	_rounding = 0
	_spreading = 0
	_tip = 0
	_out = 0
	_back = 0
	_jaw_weight = 0
	_lips_weight = 0
	_rounding_weight = 0
	_tongue_weight = 0
	_closure = 0
	_teeth = 0
	_narrow = 0


## Adds a sound.
func add(start_us: int, end_us: int, target: PackedByteArray) -> void:
	if start_us > _LONGEST_RISE_US or end_us < -_LONGEST_RISE_US:
		return
	var hold_end_us := end_us - mini((end_us - start_us) >> 2, _LONGEST_RELEASE_US)
	var done := clampi(mini(_JAW_US - start_us, hold_end_us + _JAW_US), 0, _JAW_US)
	@warning_ignore("integer_division")
	var weight := done / 140 * target[Targets.JAW_STRENGTH]
	_jaw_weight += weight
	_jaw += weight * target[Targets.JAW]
	done = clampi(mini(_LIPS_US - start_us, hold_end_us + _LIPS_US), 0, _LIPS_US)
	@warning_ignore("integer_division")
	weight = done / 120 * target[Targets.LIPS_STRENGTH]
	_lips_weight += weight
	_opening += weight * target[Targets.OPENING]
	_spreading += weight * target[Targets.SPREADING]
	done = clampi(mini(_ROUNDING_US - start_us, hold_end_us + _ROUNDING_US), 0, _ROUNDING_US)
	@warning_ignore("integer_division")
	weight = done / 150 * target[Targets.ROUNDING_STRENGTH]
	_rounding_weight += weight
	_rounding += weight * target[Targets.ROUNDING]
	done = clampi(mini(_TONGUE_US - start_us, hold_end_us + _TONGUE_US), 0, _TONGUE_US)
	@warning_ignore("integer_division")
	weight = done / 60 * _TONGUE_STRENGTH
	_tongue_weight += weight
	_tip += weight * target[Targets.TONGUE_TIP]
	_out += weight * target[Targets.TONGUE_OUT]
	_back += weight * target[Targets.TONGUE_BACK]
	var classes := target[Targets.CLASSES]
	if classes == 0:
		return
	if classes & Targets.CLOSES_LIPS:
		_closure = maxi(_closure, _lasting(start_us, end_us, hold_end_us, 60000, 45000))
	if classes & Targets.TOUCHES_TEETH:
		_teeth = maxi(_teeth, _lasting(start_us, end_us, hold_end_us, 50000, 50000))
	if classes & Targets.NARROWS_JAW:
		_narrow = maxi(_narrow, _lasting(start_us, end_us, hold_end_us, 40000, 100000))


func _lasting(start_us: int, end_us: int, hold_end_us: int, shortest_us: int, ramp_us: int) -> int:
	if _are_certain:
		return _share(start_us, maxi(end_us, start_us + shortest_us), ramp_us)
	return _share(start_us, hold_end_us, _LIPS_US) >> 1


static func _share(start_us: int, end_us: int, rise_us: int) -> int:
	return int(clampi(mini(rise_us - start_us, end_us + rise_us), 0, rise_us) * 1000 / float(rise_us))


static func _capped(value: int, cap: int, part: int) -> int:
	return mini(value, int((value * (1000 - part) + cap * part) / 1000.0))


## Ends the blend, and writes the nine values into an array.
func finish(rest: PackedByteArray, gain: int, jaw_percent: int, values: PackedInt64Array) -> void:
	var room := maxi(_FULL - _jaw_weight, 0)
	@warning_ignore("integer_division")
	var jaw := (_jaw + room * rest[Targets.JAW]) / (maxi(_jaw_weight, _FULL) / 10) * jaw_percent / 100
	@warning_ignore("integer_division")
	values[0] = _capped(mini(jaw * gain / 1000, 1000), _JAW_CAP, _narrow)
	room = maxi(_FULL - _lips_weight, 0)
	@warning_ignore("integer_division")
	var whole := maxi(_lips_weight, _FULL) / 10
	@warning_ignore("integer_division")
	var opening := (_opening + room * rest[Targets.OPENING]) / whole * gain / 1000
	values[1] = _capped(_capped(mini(opening, 1000), _TEETH_CAP, _teeth), 0, _closure)
	values[2] = _closure
	values[3] = _teeth
	@warning_ignore("integer_division")
	values[5] = (_spreading + room * rest[Targets.SPREADING]) / whole
	room = maxi(_FULL - _rounding_weight, 0)
	@warning_ignore("integer_division")
	values[4] = (_rounding + room * rest[Targets.ROUNDING]) / (maxi(_rounding_weight, _FULL) / 10)
	room = maxi(_FULL - _tongue_weight, 0)
	@warning_ignore("integer_division")
	whole = maxi(_tongue_weight, _FULL) / 10
	@warning_ignore("integer_division")
	values[6] = (_tip + room * rest[Targets.TONGUE_TIP]) / whole
	@warning_ignore("integer_division")
	values[7] = (_out + room * rest[Targets.TONGUE_OUT]) / whole
	@warning_ignore("integer_division")
	values[8] = (_back + room * rest[Targets.TONGUE_BACK]) / whole
