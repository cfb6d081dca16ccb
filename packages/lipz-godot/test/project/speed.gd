extends RefCounted
## Measures queries and rendered frames. The questions are those of docs/inside/ports.md.

const Files := preload("files.gd")
const ROUNDS := 5


static func _measure(what: String, count: int, action: Callable) -> String:
	for index in 100:
		action.call(index)
	var least := INF
	for _round in ROUNDS:
		var start := Time.get_ticks_usec()
		for index in count:
			action.call(index)
		least = minf(least, (Time.get_ticks_usec() - start) * 1000.0 / count)
	return "bench %s_ns %.1f GDScript" % [what, least]


## Returns the nanoseconds of each call, a line each.
func run() -> String:
	var bytes := Files.golden("drama.lipzbank")
	var bank := LipzBank.open(bytes)
	var clip := bank.clip("act1/mara-good-evening")
	var german := bank.locale("de-de")
	var cursor := clip.cursor("mara")
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
	return "\n" + "\n".join([
		_measure("open", 200, func(_index: int) -> void: LipzBank.open(bytes)),
		_measure("checksum", 5, func(_index: int) -> void: bank.verify_checksum()),
		_measure("clip", 2000, func(_index: int) -> void: bank.clip("act1/mara-good-evening")),
		_measure("viseme", 10000, func(index: int) -> void: clip.viseme_at(fmod(index / 60.0, 4.0))),
		_measure("tick", 2000, tick),
		_measure("weights", 1000, func(index: int) -> void:
			rig.weights_at(spoken, fmod(index / 60.0, 1.4), weights)),
		_measure("articulation", 1000, func(index: int) -> void:
			rigged.articulation().thousandths(spoken, index % 84 * 16666667)),
		_measure("face", 1000, func(index: int) -> void: LipzFace.at(spoken, fmod(index / 60.0, 1.4))),
	])
