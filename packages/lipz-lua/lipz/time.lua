--- Times and frames. A time is a number of seconds, `{ us = n }` in microseconds, or `{ position = n, rate_hz = n }`
-- in samples. Frames per second are a ratio of whole numbers.

local floor, huge = math.floor, math.huge
local EXACT = 2 ^ 53

local time = {}

--- The frame after every clip.
local LAST_FRAME = 4294967295
--- A time in seconds may be two units in the last place too early.
local TOLERANCE = 1 + 2 ^ -51

--- Returns a time as a number of units and the units per second; nil if it is before the start or invalid.
local function units(at)
  if type(at) == "number" then
    if at >= 0 then return at * TOLERANCE, 1 end
    return nil
  end
  if at.us then
    if at.us >= 0 then return at.us + 0.0, 1000000 end
    return nil
  end
  if at.position >= 0 and at.rate_hz > 0 then return at.position + 0.0, at.rate_hz end
  return nil
end

--- Whether a time is valid and not before the start.
function time.has_begun(at) return units(at) ~= nil end

--- Returns a time that is `us` microseconds later.
function time.later(at, us)
  if type(at) == "number" then return at + us / 1000000 end
  if at.us then return { us = at.us + us } end
  return { position = at.position + math.ceil(us * at.rate_hz / 1000000), rate_hz = at.rate_hz }
end

--- Returns the quotient and the rest of a * b / c for whole numbers below 2^53.
local function multiply_divide(a, b, c)
  local product = (a + 0.0) * b -- integers of Lua 5.3 would wrap around
  if product < EXACT then
    local quotient = floor(product / c)
    return quotient, product - quotient * c
  end
  -- A product with more bits than a double: long multiplication, by the bits of b.
  local whole = floor(a / c)
  local rest_of_a = a - whole * c
  local quotient, rest, bit = 0.0, 0.0, 1.0
  while bit * 2 <= b do bit = bit * 2 end
  while bit >= 1 do
    quotient, rest = quotient * 2, rest * 2
    if rest >= c then quotient, rest = quotient + 1, rest - c end
    if b >= bit then
      b, quotient, rest = b - bit, quotient + whole, rest + rest_of_a
      if rest >= c then quotient, rest = quotient + 1, rest - c end
    end
    bit = bit / 2
  end
  return quotient, rest
end
time.multiply_divide = multiply_divide

--- Returns the frame at a time; nil before the start, and `math.huge` if it is later than any clip.
function time.frame(at, numerator, denominator)
  local value, per_second = units(at)
  if not value then return nil end
  local whole = per_second * denominator
  local product = value * numerator
  if product < EXACT then return floor(product / whole) end
  if value >= EXACT then return huge end
  return (multiply_divide(value, numerator, whole))
end

--- Returns the frame at a time, and the part of the frame that has passed, in 1/65,536.
function time.position(at, numerator, denominator)
  local value, per_second = units(at)
  if not value then return 0, 0 end
  if value >= EXACT then return LAST_FRAME, 65535 end
  local frame, rest = multiply_divide(value, numerator, per_second * denominator)
  if frame >= LAST_FRAME then return LAST_FRAME, 65535 end
  return frame, (multiply_divide(rest, 65536, per_second * denominator))
end

--- Returns the first microsecond of a frame.
function time.start_of_frame_us(frame, numerator, denominator)
  local us, rest = multiply_divide(frame, denominator * 1000000, numerator)
  return rest > 0 and us + 1 or us
end

--- Returns the whole milliseconds of a time: 0 before the start, at most 2^32 - 1.
function time.milliseconds(at)
  local ms = time.frame(at, 1000, 1)
  if not ms then return 0 end
  return ms < LAST_FRAME and ms or LAST_FRAME
end

return time
