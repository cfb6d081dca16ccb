--- Rigs: the weights of a model's shapes. Inside this module, values are in thousandths.

local articulation = require("lipz.articulation")
local bytes = require("lipz.bytes")
local emotions = require("lipz.emotions")
local face = require("lipz.face")
local profiles = require("lipz.profiles")
local Bank = require("lipz.bank")
local Clip = require("lipz.clip")
local u8, u16, i16 = bytes.u8, bytes.u16, bytes.i16

local RECORD_BYTES, WEIGHT_BYTES, TERM_BYTES = 8, 8, 4
local NO_INPUT = 255
local MOST_INPUT, ONE = 4000, 1000

--- A rig, with `name`, and `weight_names`, a list.
local Rig = {}
Rig.__index = Rig

local function read_terms(section, at, count)
  local terms = {}
  for index = 1, count do
    local first = at + (index - 1) * TERM_BYTES
    local second = u8(section, first + 3)
    -- Inputs are numbered from 1, as in lists.
    terms[index] = {
      factor = i16(section, first), first = u8(section, first + 2) + 1, second = second ~= NO_INPUT and second + 1,
    }
  end
  return terms
end

local function read(section, at)
  local name_length, weight_count = u16(section, at), u16(section, at + 2)
  local term_count, names_length = u16(section, at + 4), u16(section, at + 6)
  if not names_length then return nil end
  local weights_at = at + RECORD_BYTES + name_length
  local terms_at = weights_at + weight_count * WEIGHT_BYTES
  local names_at = terms_at + term_count * TERM_BYTES
  if not bytes.part(section, names_at, names_length) then return nil end
  local rig = setmetatable({
    name = bytes.text(section, at + RECORD_BYTES, name_length), weight_names = {}, limits = {},
    terms = read_terms(section, terms_at, term_count),
  }, Rig)
  local name_start = 0
  for index = 1, weight_count do
    local first = weights_at + (index - 1) * WEIGHT_BYTES
    local name_end = u16(section, first + 2)
    local is_inside = name_end >= name_start and name_end <= names_length
    rig.weight_names[index] = is_inside and bytes.text(section, names_at + name_start, name_end - name_start) or ""
    name_start = name_end
    rig.limits[index] = {
      terms_end = u16(section, first), least = i16(section, first + 4), most = i16(section, first + 6),
    }
  end
  return rig, names_at + names_length
end

--- `bank:rigs()` returns all rigs, and `bank:rig(name)` one of them or nil.
profiles.add_queries(Bank, "RIGS", "rigs", "rig", read)

--- Returns a / 1000, rounded towards zero.
local function thousandth(a) return a < 0 and math.ceil(a / ONE) or math.floor(a / ONE) end

local function limited(value) return math.max(-MOST_INPUT, math.min(value, MOST_INPUT)) end

local inputs = {}

local function set_inputs(mouth, feelings, moved)
  for index = 1, 9 do inputs[index] = limited(mouth[index]) end
  for index = 1, 12 do
    local tenth = feelings[index] / 10
    inputs[9 + index] = limited(tenth < 0 and math.ceil(tenth) or math.floor(tenth))
  end
  inputs[22], inputs[23], inputs[24] = limited(moved.blink), limited(moved.brows), limited(moved.shrug)
  inputs[25] = ONE
end

local function compute(rig, out)
  local first, terms = 1, rig.terms
  for index, limits in ipairs(rig.limits) do
    local sum = 0
    if limits.terms_end <= #terms then
      for place = first, limits.terms_end do
        local term = terms[place]
        local product = thousandth(term.factor * (inputs[term.first] or 0))
        if term.second then product = thousandth(product * (inputs[term.second] or 0)) end
        sum = sum + product
      end
    end
    first = limits.terms_end + 1
    out[index] = math.min(math.max(sum, limits.least), limits.most) / ONE
  end
  return out
end

local mouth, feelings, moved = {}, {}, {}
local NO_FACE = { blink = 0, brows = 0, shrug = 0 }

local function in_thousandths(value) return math.floor((value or 0) * ONE + 0.5) end

--- Returns the weights for an articulation, and for emotions and a face (nil for a neutral one), as returned by the
-- queries of a clip, in the order of `weight_names`.
function Rig:weights(found, felt, at_face, out)
  for index, name in ipairs(articulation.NAMES) do mouth[index] = in_thousandths(found[name]) end
  for index, name in ipairs(emotions.NAMES) do feelings[index] = in_thousandths(felt and felt[name]) end
  for name in pairs(NO_FACE) do moved[name] = in_thousandths(at_face and at_face[name]) end
  set_inputs(mouth, feelings, moved)
  return compute(self, out or {})
end

local NO_SETTINGS = {}

--- Returns the weights of a rig at a time, in the order of `weight_names`, with articulation, emotions and face of a
-- character of the clip. Settings: `who`, `profile`, `face_profile` and `look`, as in the queries for each of them;
-- `out`, the table for the result. Pass the same settings in each rendered frame, so that no table is created.
function Clip:weights_at(at, rig, settings)
  settings = settings or NO_SETTINGS
  articulation.thousandths(self, at, settings.profile, mouth)
  emotions.thousandths(self, at, settings.who, feelings)
  face.thousandths(self, at, settings.who, settings.face_profile, settings.look, moved)
  set_inputs(mouth, feelings, moved)
  return compute(rig, settings.out or {})
end

return Rig
