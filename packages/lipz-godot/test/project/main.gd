extends Node3D
## Runs all tests, and prints a line for each group. run.js reads these lines.

const Cases := preload("cases.gd")
const Damaged := preload("damaged.gd")
const Dumps := preload("dumps.gd")
const Nodes := preload("nodes.gd")
const Outside := preload("outside.gd")
const Players := preload("players.gd")
const Speed := preload("speed.gd")


func _ready() -> void:
	print("engine: Godot ", Engine.get_version_info().string)
	_report("cases", Cases.new().play())
	_report("dumps", Dumps.new().compare_all())
	_report("damaged banks", Damaged.new().open_all())
	_report("outside", Outside.new().run())
	_report("players", Players.new(self).run())
	_report("speed", Speed.new().run())
	var nodes := Nodes.new(self)
	_report("nodes", nodes.run())
	_report("audio", await nodes.test_audio())
	await _run_pages()
	await _run_sample()
	print("DONE")


func _report(group: String, result: String) -> void:
	print(group, ": ", result)


## Runs the first programs of the pages, whose output run.js compares.
func _run_pages() -> void:
	Engine.time_scale = 4.0
	for page in ["guide", "readme"]:
		print("BEGIN ", page)
		var node: Node = (load("res://%s.gd" % page) as GDScript).new()
		add_child(node)
		await get_tree().create_timer(9.0).timeout
		node.free()
		print("END ", page)


## Plays the sample, and prints its picture in the middle of the first line, for a look at it.
func _run_sample() -> void:
	var sample: Node = (load("res://sample.tscn") as PackedScene).instantiate()
	add_child(sample)
	await get_tree().create_timer(1.0).timeout
	await RenderingServer.frame_post_draw
	var picture := get_viewport().get_texture().get_image().save_png_to_buffer()
	var subtitle: Label = sample.get_node("Subtitle")
	var first := subtitle.text
	await get_tree().create_timer(5.0).timeout
	print("PICTURE ", Marshalls.raw_to_base64(picture))
	_report("sample", "%s / %s" % [first, subtitle.text])
