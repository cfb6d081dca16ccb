extends RefCounted
## Measures queries and rendered frames.

const Files := preload("files.gd")


static func _measure(what: String, count: int, action: Callable) -> String:
	for index in 100:
		action.call(index)
	var start := Time.get_ticks_usec()
	for index in count:
		action.call(index)
	return "%s %.1f us" % [what, (Time.get_ticks_usec() - start) / float(count)]


## Returns the microseconds of each call.
func run() -> String:
	var bytes := Files.golden("drama.lipzbank")
	var bank := LipzBank.open(bytes)
	var clip := bank.clip("act1/mara-good-evening")
	var german := bank.locale("de-de")
	var cursor := clip.cursor("mara")
	cursor.set_hold_readable()
	var rigged := Files.bank("phones")
	var spoken := rigged.clip("spoken")
	var rig := rigged.rig("arkit")
	var weights := PackedFloat32Array()
	weights.resize(rig.weight_names.size())
	var tick := func(index: int) -> void:
		var seconds := fmod(index / 60.0, 4.0)
		if seconds < 0.01:
			cursor.seek(seconds)
		cursor.advance_to(seconds)
		cursor.viseme()
		cursor.text(german)
	return ", ".join([
		_measure("open", 200, func(_index: int) -> void: LipzBank.open(bytes)),
		_measure("checksum of %d bytes" % bytes.size(), 20, func(_index: int) -> void: bank.verify_checksum()),
		_measure("clip(key)", 5000, func(_index: int) -> void: bank.clip("act1/mara-good-evening")),
		_measure("viseme_at", 20000, func(index: int) -> void: clip.viseme_at(index * 0.00015)),
		_measure("tick", 5000, tick),
		_measure("35 weights", 3000, func(index: int) -> void:
			rig.weights_at(spoken, fmod(index / 60.0, 1.4), weights)),
		_measure("articulation", 3000, func(index: int) -> void:
			rigged.articulation().thousandths(spoken, index % 84 * 16666667)),
		_measure("face", 3000, func(index: int) -> void: LipzFace.at(spoken, fmod(index / 60.0, 1.4))),
	])
