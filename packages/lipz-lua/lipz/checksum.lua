--- The checksum of a bank: XXH64 of docs/reference/bank-format.md. For each 10 MB, it takes about 0.1 seconds
-- with LuaJIT, and 2 or 3 seconds without, so check banks that were downloaded, not those that you ship.

local bytes = require("lipz.bytes")
local file = require("lipz.file")
local refuse = require("lipz.error")
local u64 = require("lipz.u64")
local Bank = require("lipz.bank")

local floor = math.floor
local CHECKSUM_OFFSET, FIRST = 8, 16
local WORD = 4294967296
local P1H, P1L = 0x9E3779B1, 0x85EBCA87
local P2H, P2L = 0xC2B2AE3D, 0x27D4EB4F
local P3H, P3L = 0x165667B1, 0x9E3779F9
local P4H, P4L = 0x85EBCA77, 0xC2B2AE63

local function rotate(high, low, bits)
  if bits >= 32 then high, low, bits = low, high, bits - 32 end
  local up, down = 2 ^ bits, 2 ^ (32 - bits)
  return (high * up) % WORD + floor(low / down), (low * up) % WORD + floor(high / down)
end

local function round(high, low, word_high, word_low)
  high, low = u64.add(high, low, u64.mul(word_high, word_low, P2H, P2L))
  high, low = rotate(high, low, 31)
  return u64.mul(high, low, P1H, P1L)
end

--- Returns the exclusive or of a number and itself, shifted right.
local function fold(high, low, bits)
  if bits >= 32 then return high, u64.xor32(low, floor(high / 2 ^ (bits - 32))) end
  local down = 2 ^ bits
  return u64.xor32(high, floor(high / down)), u64.xor32(low, floor(low / down) + high % down * 2 ^ (32 - bits))
end

--- Returns the checksum of the bytes of a string from an offset, as its high and low 32 bits.
local function checksum(data, first)
  local padded = data:sub(first + 1) .. "\1"
  padded = padded .. ("\0"):rep((32 - #padded % 32) % 32)
  local section = { data = padded, start = 0, length = #padded }
  local lane_high, lane_low = {}, {}
  lane_high[0], lane_low[0] = u64.add(P1H, P1L, P2H, P2L)
  lane_high[1], lane_low[1] = P2H, P2L
  lane_high[2], lane_low[2] = 0, 0
  lane_high[3], lane_low[3] = WORD - 1 - P1H, WORD - P1L
  for at = 0, #padded - 8, 8 do
    local lane = floor(at / 8) % 4
    lane_high[lane], lane_low[lane] =
      round(lane_high[lane], lane_low[lane], bytes.u32(section, at + 4), bytes.u32(section, at))
  end
  local high, low = 0, 0
  for lane, bits in ipairs({ 1, 7, 12, 18 }) do
    high, low = u64.add(high, low, rotate(lane_high[lane - 1], lane_low[lane - 1], bits))
  end
  for lane = 0, 3 do
    local lane_h, lane_l = round(0, 0, lane_high[lane], lane_low[lane])
    high, low = u64.mul(u64.xor32(high, lane_h), u64.xor32(low, lane_l), P1H, P1L)
    high, low = u64.add(high, low, P4H, P4L)
  end
  high, low = u64.add(high, low, 0, #padded)
  high, low = fold(high, low, 33)
  high, low = u64.mul(high, low, P2H, P2L)
  high, low = fold(high, low, 29)
  high, low = u64.mul(high, low, P3H, P3L)
  return fold(high, low, 32)
end

local function is_intact(whole)
  local high, low = checksum(whole.data, FIRST)
  return bytes.u32(whole, CHECKSUM_OFFSET) == low and bytes.u32(whole, CHECKSUM_OFFSET + 4) == high
end

--- Compares the checksum in the header with the bytes. Returns the bank, or nil and an error if the file is damaged.
function Bank:verify_checksum()
  if not is_intact(self.whole) then return refuse("Checksum", CHECKSUM_OFFSET) end
  return self
end

--- Compares the checksum of a text bank, a string, with its bytes. Returns the bank, or nil and an error if the text
-- bank is damaged. Then open it with `open_texts`, which checks its header and its directory.
function Bank:verify_texts(data)
  local opened, message, problem = file.open(data)
  if not opened then return nil, message, problem end
  if not is_intact(opened.whole) then return refuse("Checksum", CHECKSUM_OFFSET) end
  return self
end

return checksum
