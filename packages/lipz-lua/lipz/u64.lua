--- Numbers of 64 bits, each as its high and its low 32 bits, because doubles have only 53 exact bits.

local floor = math.floor
local HALF, WORD = 65536, 4294967296

local u64 = {}

--- Returns a function that computes the exclusive or of two numbers of 32 bits, as fast as this Lua allows.
local function exclusive_or()
  local has_bit, bit = pcall(require, "bit") -- LuaJIT, LÖVE, Defold
  if has_bit then
    local xor = bit.bxor
    return function(a, b) return xor(a, b) % WORD end
  end
  local has_operators = (loadstring or load)("return function(a, b) return a ~ b end") -- Lua 5.3 and newer
  if has_operators then
    local xor = has_operators()
    return function(a, b) return xor(floor(a), floor(b)) end
  end
  local nibbles = {}
  for a = 0, 15 do
    for b = 0, 15 do
      local value, place = 0, 1
      for _ = 1, 4 do
        if floor(a / place) % 2 ~= floor(b / place) % 2 then value = value + place end
        place = place * 2
      end
      nibbles[a * 16 + b] = value
    end
  end
  return function(a, b)
    local value, place = 0, 1
    for _ = 1, 8 do
      local x, y = a % 16, b % 16
      value = value + nibbles[x * 16 + y] * place
      a, b, place = (a - x) / 16, (b - y) / 16, place * 16
    end
    return value
  end
end

local xor32 = exclusive_or()
u64.xor32 = xor32

--- Returns the low 32 bits of a product of two numbers of 32 bits.
local function mul32(a, b)
  local low = b % HALF
  local high = (b - low) / HALF
  return (a * low + (a * high % HALF) * HALF) % WORD
end
u64.mul32 = mul32

--- Returns the product of two numbers modulo 2^64.
function u64.mul(a_high, a_low, b_high, b_low)
  local a0, b0 = a_low % HALF, b_low % HALF
  local a1, b1 = (a_low - a0) / HALF, (b_low - b0) / HALF
  local low = a0 * b0
  local middle = a0 * b1 + a1 * b0 + floor(low / HALF)
  local carried = floor(middle / HALF)
  local high = a1 * b1 + carried + mul32(a_high, b_low) + mul32(a_low, b_high)
  return high % WORD, (middle - carried * HALF) * HALF + low % HALF
end

function u64.add(a_high, a_low, b_high, b_low)
  local low = a_low + b_low
  local carried = low >= WORD and 1 or 0
  return (a_high + b_high + carried) % WORD, low % WORD
end

--- The function `mix` of docs/reference/bank-format.md.
local function mix(high, low, by_high, by_low)
  high, low = u64.mul(high, low, by_high, by_low)
  return high, xor32(low, high)
end

local STEP_HIGH, STEP_LOW = 0x9E3779B9, 0x7F4A7C15
local FINISH_HIGH, FINISH_LOW = 0x9FB21C65, 0x1E98DF25

--- Mixes with the multiplier 0x9E3779B97F4A7C15.
function u64.step(high, low) return mix(high, low, STEP_HIGH, STEP_LOW) end

--- Mixes with the multiplier 0x9FB21C651E98DF25.
function u64.finish(high, low) return mix(high, low, FINISH_HIGH, FINISH_LOW) end

local function word(text, at)
  local a, b, c, d = text:byte(at, at + 3)
  return (a or 0) + (b or 0) * 256 + (c or 0) * 65536 + (d or 0) * 16777216
end

--- Returns the clip id of a key.
function u64.clip_id(key)
  local high, low = u64.step(0, #key)
  for at = 1, #key - #key % 8, 8 do
    high, low = u64.step(xor32(high, word(key, at + 4)), xor32(low, word(key, at)))
  end
  local tail = #key - #key % 8 + 1
  return u64.finish(u64.step(xor32(high, word(key, tail + 4)), xor32(low, word(key, tail))))
end

--- Returns the 16 hexadecimal digits of a number.
function u64.hex(high, low) return ("%08x%08x"):format(high, low) end

return u64
