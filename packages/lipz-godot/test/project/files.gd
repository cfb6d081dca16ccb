extends RefCounted
## The files of the tests.


static func golden(file_name: String) -> PackedByteArray:
	return FileAccess.get_file_as_bytes("res://fixtures/banks/v1/" + file_name)


static func bank(bank_name: String) -> LipzBank:
	return LipzBank.open(golden(bank_name + ".lipzbank"))


static func lines(path: String) -> PackedStringArray:
	return FileAccess.get_file_as_bytes(path).get_string_from_utf8().split("\n")


## Returns a message about the first different line, or an empty string.
static func difference(name: String, found: PackedStringArray, expected: PackedStringArray) -> String:
	for index in maxi(found.size(), expected.size()):
		var a := found[index] if index < found.size() else "(none)"
		var b := expected[index] if index < expected.size() else "(none)"
		if a != b:
			return "FAILED %s:%d\n  expected: %s\n  found:    %s" % [name, index + 1, b, a]
	return ""
