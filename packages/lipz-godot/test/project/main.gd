extends Node3D
## Runs all tests, and prints a line for each group. run.js reads these lines.

const Cases := preload("cases.gd")
const Damaged := preload("damaged.gd")
const Dumps := preload("dumps.gd")
const Speed := preload("speed.gd")


func _ready() -> void:
	print("engine: Godot ", Engine.get_version_info().string, ", debug ", OS.is_debug_build())
	_report("cases", Cases.new().play())
	_report("dumps", Dumps.new().compare_all())
	_report("damaged banks", Damaged.new().open_all())
	_report("speed", Speed.new().run())
	print("DONE")


func _report(group: String, result: String) -> void:
	print(group, ": ", result)
