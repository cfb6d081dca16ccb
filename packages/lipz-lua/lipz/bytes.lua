--- Little-endian numbers in the sections of a bank. Offsets are in bytes from the start of a section. A read outside
-- the section returns nil, so a damaged bank cannot cause an error.

local byte = string.byte

local bytes = {}

--- A section without bytes.
bytes.EMPTY = { data = "", start = 0, length = 0 }

--- Returns the part of `section` from `at`, or nil if it is not inside.
function bytes.part(section, at, length)
  if at < 0 or length < 0 or at + length > section.length then return nil end
  return { data = section.data, start = section.start + at, length = length }
end

--- Returns the bytes from `at` as a string, or nil if they are not inside.
function bytes.text(section, at, length)
  if not at or not length or length < 0 or at + length > section.length then return nil end
  return section.data:sub(section.start + at + 1, section.start + at + length)
end

function bytes.u8(section, at)
  if at < 0 or at >= section.length then return nil end
  return byte(section.data, section.start + at + 1)
end

function bytes.u16(section, at)
  if at < 0 or at + 2 > section.length then return nil end
  local low, high = byte(section.data, section.start + at + 1, section.start + at + 2)
  return low + high * 256
end

--- A signed number in two's complement.
function bytes.i16(section, at)
  local value = bytes.u16(section, at)
  if not value then return nil end
  return value < 32768 and value or value - 65536
end

function bytes.u32(section, at)
  if at < 0 or at + 4 > section.length then return nil end
  local a, b, c, d = byte(section.data, section.start + at + 1, section.start + at + 4)
  return a + b * 256 + c * 65536 + d * 16777216
end

--- A signed number in two's complement.
function bytes.i32(section, at)
  local value = bytes.u32(section, at)
  if not value then return nil end
  return value < 2147483648 and value or value - 4294967296
end

return bytes
