--- The blend of sounds that overlap: the formulas of docs/reference/bank-format.md, computing articulation. Values
-- are in thousandths, times in microseconds from the query.

local floor, min, max = math.floor, math.min, math.max

local RISE_US = { 140000, 120000, 150000, 60000 } -- jaw, lips, rounding, tongue
local LONGEST_RISE_US = 150000
local GROUPS = { 1, 2, 3, 2, 4, 4, 4 } -- the group of each percentage
local TONGUE_STRENGTH = 10
local LONGEST_RELEASE_US = 40000
local LIPS_US = 120000
local JAW_CAP, TEETH_CAP = 80, 150
local FULL_WEIGHT = 10000

local blend = { sums = {}, weights = {}, added = {} }

--- Starts a blend.
function blend.start(are_certain)
  for index = 1, 7 do blend.sums[index] = 0 end
  for index = 1, 4 do blend.weights[index] = 0 end
  blend.are_certain = are_certain
  blend.closure, blend.teeth, blend.narrow = 0, 0, 0
end

local function share(start_us, end_us, rise_us)
  local done = max(min(rise_us - start_us, end_us + rise_us, rise_us), 0)
  return floor(done * 1000 / rise_us)
end

local function lasting(start_us, end_us, hold_end_us, shortest_us, ramp_us)
  if blend.are_certain then return share(start_us, max(end_us, start_us + shortest_us), ramp_us) end
  return floor(share(start_us, hold_end_us, LIPS_US) / 2)
end

--- Adds a sound that lasts from `start_us` to `end_us`.
function blend.add(start_us, end_us, target)
  if start_us > LONGEST_RISE_US or end_us < -LONGEST_RISE_US then return end
  local hold_end_us = end_us - min(floor((end_us - start_us) / 4), LONGEST_RELEASE_US)
  local added, weights, strengths = blend.added, blend.weights, target.strength_tenths
  for group = 1, 4 do
    added[group] = share(start_us, hold_end_us, RISE_US[group]) * (strengths[group] or TONGUE_STRENGTH)
    weights[group] = weights[group] + added[group]
  end
  for index = 1, 7 do blend.sums[index] = blend.sums[index] + added[GROUPS[index]] * target.percent[index] end
  if target.closes_lips then
    blend.closure = max(blend.closure, lasting(start_us, end_us, hold_end_us, 60000, 45000))
  end
  if target.touches_teeth then
    blend.teeth = max(blend.teeth, lasting(start_us, end_us, hold_end_us, 50000, 50000))
  end
  if target.narrows_jaw then
    blend.narrow = max(blend.narrow, lasting(start_us, end_us, hold_end_us, 40000, 100000))
  end
end

local function capped(value, cap, part) return min(value, floor((value * (1000 - part) + cap * part) / 1000)) end

local function value_of(index, rest)
  local weight = blend.weights[GROUPS[index]]
  local total = blend.sums[index] + max(FULL_WEIGHT - weight, 0) * rest.percent[index]
  return floor(total / floor(max(weight, FULL_WEIGHT) / 10))
end

--- Ends the blend, and writes the nine values into `out`. `rest` is the target of the mouth at rest, `gain` and
-- `jaw_percent` are those of the profile.
function blend.finish(rest, gain, jaw_percent, out)
  local jaw = floor(value_of(1, rest) * jaw_percent / 100)
  jaw = min(floor(jaw * gain / 1000), 1000)
  local opening = min(floor(value_of(2, rest) * gain / 1000), 1000)
  out[1] = capped(jaw, JAW_CAP, blend.narrow)
  out[2] = capped(capped(opening, TEETH_CAP, blend.teeth), 0, blend.closure)
  out[3], out[4] = blend.closure, blend.teeth
  for index = 3, 7 do out[index + 2] = value_of(index, rest) end
  return out
end

return blend
