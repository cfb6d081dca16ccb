--- Damage inside a text bank, which only the checksum covers.

local files = require("test.files")
local lipz = require("lipz")

--- Verifies intact and damaged text banks. Returns their number.
return function()
  local bank = assert(lipz.open(files.golden("split.lipzbank")))
  local count = 0
  for _, tag in ipairs({ "de-de", "en-us" }) do
    local intact = files.golden(("split.%s.lipztexts"):format(tag))
    assert(bank:verify_texts(intact) == bank, tag)
    local damaged = intact:sub(1, -2) .. string.char((intact:byte(-1) + 1) % 256)
    local verified, _, problem = bank:verify_texts(damaged)
    assert(not verified and problem.kind == "Checksum" and problem.offset_bytes == 8, tag)
    local cut, _, reason = bank:verify_texts(intact:sub(1, -2))
    assert(not cut and reason.kind == "WrongLength", tag)
    count = count + 3
  end
  return count
end
