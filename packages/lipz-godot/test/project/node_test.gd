extends RefCounted
## The start of tests of nodes: expectations, and a player that the test advances itself.

var _root: Node
var _heard := PackedStringArray()
var _problems := PackedStringArray()


func _init(root: Node) -> void:
	_root = root


func _expect(what: String, found: Variant, expected: Variant) -> void:
	if found != expected:
		_problems.append("FAILED %s: %s instead of %s" % [what, found, expected])


## Returns a player of German subtitles. The log has its events.
func _player(bank: LipzBank) -> LipzPlayer:
	var player := LipzPlayer.new()
	player.bank = bank
	player.locale = "de-de"
	_root.add_child(player)
	player.set_process(false)
	_heard.clear()
	player.event_fired.connect(func(event: LipzEvent) -> void: _heard.append(str(event)))
	return player
