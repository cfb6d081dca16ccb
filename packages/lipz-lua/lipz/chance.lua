--- Chance that depends only on a seed: the formulas of docs/guides/faces.md, generated motion.

local u64 = require("lipz.u64")
local floor = math.floor

local chance = {}

--- The whole of a part.
chance.WHOLE = 65536

--- The streams, one for each use of chance.
chance.STREAMS = {
  blink_phase = 1, blink_time = 2, double_blink = 3, pose_time = 4, pitch = 5, yaw = 6, roll = 7, fixation_time = 8,
  glance = 9, target = 10, eye_pitch = 11, eye_yaw = 12,
}

--- Returns a number from 0 to 65,535. The seed is `{ high, low }`.
function chance.draw(seed, stream, interval, index)
  local high, low = u64.step(seed[1], u64.xor32(seed[2], interval * 256 + stream))
  high, low = u64.finish(high, u64.xor32(low, index))
  high = u64.step(high, low)
  return floor(high / 65536)
end

--- Returns a number from 0 up to but not including `amount`.
function chance.part(amount, draw) return floor(amount * draw / 65536) end

--- Returns a number from `-amount` up to `amount`.
function chance.either_side(amount, draw) return chance.part(2 * amount, draw) - amount end

--- Returns `value * part / whole`, rounded towards zero.
function chance.scaled(value, part, whole)
  local product = value * part / whole
  return product < 0 and math.ceil(product) or floor(product)
end

--- Returns the time of a step, in the first half of its period.
local function start_ms(seed, stream, period_ms, number)
  return number * period_ms + chance.part(floor(period_ms / 2), chance.draw(seed, stream, 0, number))
end

--- Returns the numbers of the states before and after the last step, and how much of the step is done, of `WHOLE`.
function chance.step(seed, ms, stream, period_ms, duration_ms)
  local number = period_ms > 0 and floor(ms / period_ms) or 0
  local started = start_ms(seed, stream, period_ms, number)
  if ms < started then
    number = number - 1
    if number < 0 then return 0, 0, chance.WHOLE end
    started = start_ms(seed, stream, period_ms, number)
  end
  local passed = ms - started
  return number, number + 1, passed < duration_ms and floor(passed * chance.WHOLE / duration_ms) or chance.WHOLE
end

return chance
