@icon("icon.svg")
class_name LipzFace3D
extends Node
## Moves the blend shapes of a mesh while a [LipzPlayer] plays. The shapes are found by their names: ARKit, OVR,
## VRM, MMD, or the names in a rig of your project. When the line ends, they rest.

## Not a sum of any weight.
const _NOT_SHOWN := 0x7FFFFFFFFFFFFFFF

## The player whose clips move the face.
@export var player: LipzPlayer
## The mesh with the blend shapes.
@export var mesh: MeshInstance3D:
	set(value):
		mesh = value
		_shapes = null
## The rig of the bank. If it is empty, the shapes of the mesh decide.
@export var rig := ""
## The name of the character whose face it is. If it is empty, the face is that of the speaker of each clip.
@export var character := ""

var _shapes: LipzShapes
var _rig: LipzRig
var _bank: LipzBank
## The weights that have a shape, these shapes, and the sums whose weights they show.
var _from := PackedInt32Array()
var _to := PackedInt32Array()
var _shown := PackedInt64Array()
var _is_resting := true


func _process(_delta: float) -> void:
	if not is_instance_valid(player) or not is_instance_valid(mesh) or mesh.mesh == null:
		return
	if player.clip == null:
		rest()
		return
	if _shapes == null or player.bank != _bank:
		_find_shapes()
	if _to.is_empty():
		return
	_is_resting = false
	if _rig == null:
		_show_viseme(player.viseme())
		return
	var is_speaker := character == "" or character == player.speaker
	var who := player.speaker if is_speaker else character
	_rig._compute(player.clip, player.time_ns(), who, is_speaker, null)
	var sums := _rig._sums
	for index in _from.size():
		var sum := sums[_from[index]]
		if sum != _shown[index]:
			_shown[index] = sum
			mesh.set_blend_shape_value(_to[index], _rig._weight(_from[index]))


## Sets all shapes of the face to 0.
func rest() -> void:
	if _is_resting or _shapes == null:
		return
	for index in _to.size():
		mesh.set_blend_shape_value(_to[index], 0.0)
	_shown.fill(_NOT_SHOWN)
	_is_resting = true


## For a model with a shape for each viseme: sets its shape to 1, and all others to 0.
func _show_viseme(viseme: String) -> void:
	for index in _to.size():
		mesh.set_blend_shape_value(_to[index], 1.0 if _shapes.weight_names[_from[index]] == viseme else 0.0)


func _find_shapes() -> void:
	_bank = player.bank
	var names := PackedStringArray()
	for index in mesh.get_blend_shape_count():
		names.append((mesh.mesh as ArrayMesh).get_blend_shape_name(index))
	_rig = _bank.rig(rig) if rig != "" else null
	_shapes = LipzShapes.recognise(names, _rig)
	if _rig == null:
		_rig = _bank.rig(_shapes.kind)
	if _rig != null:
		_shapes = LipzShapes.recognise(names, _rig)
	_warn()
	_from.clear()
	_to.clear()
	for weight in _shapes.indices.size():
		if _shapes.indices[weight] >= 0:
			_from.append(weight)
			_to.append(_shapes.indices[weight])
	_shown.resize(_from.size())
	_shown.fill(_NOT_SHOWN)


func _warn() -> void:
	if rig != "" and _rig == null:
		push_warning("lipz: the bank does not have the rig ", rig, ": add it to [rig] in lipz.toml")
	elif _rig == null and not _shapes.kind in ["blair", "toonboom", "rms"]:
		push_warning("lipz: add %s = true to [rig] in lipz.toml" % (_shapes.kind if _shapes.kind != "" else "a rig"))
	if _shapes.report != "":
		push_warning("lipz: ", _shapes.report)


func _exit_tree() -> void:
	if is_instance_valid(mesh):
		rest()
