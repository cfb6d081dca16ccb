--- The targets of phones and visemes: how far jaw, lips and tongue move for each (docs/reference/bank-format.md).

local bytes = require("lipz.bytes")

local TARGET_BYTES = 12

local targets = {}

--- A target: seven percentages (jaw, opening, rounding, spreading, tip, protrusion and back of the tongue), three
-- strengths in tenths (jaw, lips, rounding), the three classes, and the number of the second sound.
local function target(percent, strength_tenths, classes, second)
  return {
    percent = percent, strength_tenths = strength_tenths, second = second,
    closes_lips = classes % 2 >= 1, touches_teeth = classes % 4 >= 2, narrows_jaw = classes % 8 >= 4,
  }
end

--- The mouth at rest, for phones without a target.
targets.REST = target({ 5, 12, 10, 0, 0, 0, 0 }, { 0, 0, 0 }, 0, 0)

local SHAPES = {
  S = target({ 22, 50, 15, 20, 70, 0, 20 }, { 7, 6, 5 }, 0),
  M = target({ 25, 0, 5, 0, 0, 0, 0 }, { 7, 10, 5 }, 1),
  F = target({ 20, 15, 0, 0, 0, 0, 0 }, { 7, 10, 5 }, 2),
  A = target({ 85, 85, 5, 10, 0, 0, 10 }, { 10, 10, 10 }, 0),
  E = target({ 40, 65, 5, 50, 0, 0, 0 }, { 10, 10, 10 }, 0),
  O = target({ 60, 55, 50, 0, 0, 0, 40 }, { 10, 10, 15 }, 0),
  U = target({ 28, 32, 70, 0, 0, 0, 40 }, { 10, 14, 15 }, 0),
  W = target({ 20, 15, 90, 0, 0, 0, 40 }, { 7, 14, 15 }, 0),
  L = target({ 35, 55, 5, 0, 100, 20, 0 }, { 7, 6, 5 }, 0),
}
local BLAIR_OF_TOONBOOM = { B = "S", A = "M", G = "F", D = "A", C = "E", E = "O", F = "U" }
local PERCENT_OF_LEVEL = { 0, 11, 22, 33, 44, 55, 66, 77, 88, 100 }

local OF_TYPE = { blair = SHAPES, toonboom = {}, rms = {} }
for code, blair in pairs(BLAIR_OF_TOONBOOM) do OF_TYPE.toonboom[code] = SHAPES[blair] end
for level = 0, 9 do
  local percent = PERCENT_OF_LEVEL[level + 1]
  OF_TYPE.rms[tostring(level)] = target({ percent, percent, 0, 0, 0, 0, 0 }, { 10, 10, 10 }, 0)
end

--- Returns the target of a viseme.
function targets.of_viseme(viseme_type, viseme) return OF_TYPE[viseme_type][viseme] or SHAPES.S end

--- Reads `count` targets from a section. Returns a list, in the order of the numbers of the phones.
function targets.read(section, at, count)
  local list = {}
  for index = 1, count do
    local first = at + (index - 1) * TARGET_BYTES
    local percent, strength_tenths = {}, {}
    for place = 1, 7 do percent[place] = bytes.u8(section, first + place - 1) end
    for place = 1, 3 do strength_tenths[place] = bytes.u8(section, first + 6 + place) end
    list[index] = target(percent, strength_tenths, bytes.u8(section, first + 10), bytes.u8(section, first + 11))
  end
  return list
end

--- The bytes of `count` targets.
function targets.length(count) return count * TARGET_BYTES end

return targets
