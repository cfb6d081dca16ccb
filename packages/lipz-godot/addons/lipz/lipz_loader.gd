@tool
class_name LipzBankLoader
extends ResourceFormatLoader
## Loads banks: [code]load("res://voices.lipzbank")[/code]. Godot finds this class by its base class, so you do not
## have to enable a plugin.
##
## All bytes are compared with the checksum, which takes about a millisecond for each 10 kB. To load a large bank without
## this check, pass its contents to [method LipzBank.open].

const Errors := preload("errors.gd")


func _get_recognized_extensions() -> PackedStringArray:
	return PackedStringArray(["lipzbank"])


func _handles_type(type: StringName) -> bool:
	return type == &"Resource"


func _get_resource_type(path: String) -> String:
	return "Resource" if path.get_extension().to_lower() == "lipzbank" else ""


func _load(path: String, _original_path: String, _use_sub_threads: bool, _cache_mode: int) -> Variant:
	var bytes := FileAccess.get_file_as_bytes(path)
	if bytes.is_empty():
		return FileAccess.get_open_error() if FileAccess.get_open_error() != OK else ERR_FILE_CORRUPT
	var bank := LipzBank.open(bytes)
	if bank == null:
		return ERR_FILE_CORRUPT
	if not bank.verify_checksum():
		push_error("lipz: ", Errors.problem("Checksum", 8).message)
		return ERR_FILE_CORRUPT
	return bank
