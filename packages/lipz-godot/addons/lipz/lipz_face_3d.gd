@icon("icon.svg")
class_name LipzFace3D
extends Node
## Moves the blend shapes of a mesh while a [LipzPlayer] plays. The shapes are found by their names: ARKit, OVR, VRM, MMD,
## or the names in a rig of your project. When the line ends, they rest.

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
var _weights := PackedFloat32Array()
var _shown := PackedFloat32Array()
## The weights that have a shape, and these shapes.
var _from := PackedInt32Array()
var _to := PackedInt32Array()
var _is_resting := true


func _process(_delta: float) -> void:
	if player == null or mesh == null or mesh.mesh == null:
		return
	if player.clip == null:
		rest()
		return
	if _shapes == null or player.bank != _bank:
		_find_shapes()
	if _to.is_empty():
		return
	if _rig == null:
		for index in _weights.size():
			_weights[index] = 1.0 if _shapes.weight_names[index] == player.viseme() else 0.0
	else:
		var is_speaker := character == "" or character == player.speaker
		var who := player.speaker if is_speaker else character
		_rig._weights_at_ns(player.clip, player.time_ns(), _weights, who, is_speaker, null)
	_apply()


## Sets all shapes of the face to 0.
func rest() -> void:
	if _is_resting or _shapes == null:
		return
	_weights.fill(0.0)
	_apply()
	_is_resting = true


## Sets the shapes whose weight has changed.
func _apply() -> void:
	_is_resting = false
	for index in _from.size():
		var weight := _weights[_from[index]]
		if weight != _shown[index]:
			_shown[index] = weight
			mesh.set_blend_shape_value(_to[index], weight)


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
	_weights.resize(_shapes.weight_names.size())
	_weights.fill(0.0)
	_shown.resize(_from.size())
	_shown.fill(0.0)


func _warn() -> void:
	if rig != "" and _rig == null:
		push_warning("lipz: the bank does not have the rig ", rig, ": add it to [rig] in lipz.toml")
	elif _rig == null and not _shapes.kind in ["blair", "toonboom", "rms"]:
		push_warning("lipz: add %s = true to [rig] in lipz.toml" % (_shapes.kind if _shapes.kind != "" else "a rig"))
	if _shapes.report != "":
		push_warning("lipz: ", _shapes.report)


func _exit_tree() -> void:
	if mesh != null:
		rest()
