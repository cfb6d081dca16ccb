--- Babble: mouth movement without visemes, from the power of the voice.

local bytes = require("lipz.bytes")
local profiles = require("lipz.profiles")
local time = require("lipz.time")
local Bank = require("lipz.bank")
local u16, u32 = bytes.u16, bytes.u32

local RECORD_BYTES = 32
local ZERO = ("0"):byte()
--- The openness of a product of two digits: 121 ten-thousandths.
local OPENNESS_OF_PRODUCT = 0.0121

--- A babble profile, with `name`.
local Babble = {}
Babble.__index = Babble

local DEFAULT = setmetatable({
  name = "default", ooh = "1247898743223344444443200000", aah = "257998776531013446642343",
  ooh_power_transfer = "0012345566778899", aah_power_transfer = "0000123456789",
  rate_numerator = 24, rate_denominator = 1,
}, Babble)

local STRINGS = { "name", "ooh", "aah", "ooh_power_transfer", "aah_power_transfer" }

local function read(section, at)
  local numerator, denominator = u32(section, at + 8), u32(section, at + 12)
  local babble = setmetatable({ rate_numerator = numerator, rate_denominator = denominator }, Babble)
  local first = at + RECORD_BYTES
  for index, field in ipairs(STRINGS) do
    local length = u16(section, at + 14 + index * 2)
    local text = bytes.text(section, first, length)
    if not text then return nil end
    babble[field], first = text, first + length
  end
  if babble.rate_numerator == 0 or babble.rate_denominator == 0 then return nil end
  return babble, first
end

--- `bank:babbles()` returns all babble profiles, and `bank:babble(name)` one of them or nil.
profiles.add_queries(Bank, "BABL", "babbles", "babble", read)

--- Returns the babble profile of the project, or the built-in one.
function Bank:default_babble() return self:babble("default") or DEFAULT end

local function openness(loop, index, transfer, power)
  if #loop == 0 or #transfer == 0 then return 0 end
  if power ~= power then power = 0 end
  local digit = loop:byte(index % #loop + 1)
  local place = math.max(0, math.min(math.floor(power * #transfer), #transfer - 1))
  local factor = transfer:byte(place + 1)
  return digit and factor and (digit - ZERO) * (factor - ZERO) * OPENNESS_OF_PRODUCT or 0
end

--- Returns how far the lips are rounded and how far the jaw is open, each from 0 to about 1, some time after the voice
-- has started. `power` is that of the voice, from 0 to 1.
function Babble:at(elapsed, power)
  local index = time.frame(elapsed, self.rate_numerator, self.rate_denominator)
  if not index or index >= 4294967295 then return 0, 0 end
  return openness(self.ooh, index, self.ooh_power_transfer, power),
    openness(self.aah, index, self.aah_power_transfer, power)
end

return Babble
